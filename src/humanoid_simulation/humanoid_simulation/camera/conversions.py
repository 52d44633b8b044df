# SPDX-License-Identifier: Apache-2.0
"""Turn pictures and the geometry of a camera into messages."""

from __future__ import annotations

from array import array
from typing import Any

from builtin_interfaces.msg import Time
from humanoid_simulation.camera.pinhole import Pinhole
import numpy as np
from numpy.typing import NDArray
from sensor_msgs.msg import CameraInfo, Image

_NANOSECONDS = 1_000_000_000


def stamp_of(time_ns: int) -> Time:
    """Return a time as ROS writes it."""
    seconds, nanoseconds = divmod(time_ns, _NANOSECONDS)
    return Time(sec=seconds, nanosec=nanoseconds)


def color_image(pinhole: Pinhole, frame: str) -> Image:
    """Return a message for colour pictures, rgb8, to be filled again and again."""
    return _image(pinhole, frame, 'rgb8', 3)


def depth_image(pinhole: Pinhole, frame: str) -> Image:
    """Return a message for depth pictures, 32FC1 in metres, to be filled again and again."""
    return _image(pinhole, frame, '32FC1', 4)


def fill_image(image: Image, pixels: NDArray[Any], stamp: Time) -> None:
    """Put a picture of the right size into a message."""
    np.frombuffer(image.data, np.uint8)[:] = pixels.reshape(-1).view(np.uint8)
    image.header.stamp = stamp


def camera_info(pinhole: Pinhole, frame: str) -> CameraInfo:
    """Describe a camera without distortion; its picture is as it would be rectified."""
    info = CameraInfo(
        width=pinhole.width_px,
        height=pinhole.height_px,
        distortion_model='plumb_bob',
        d=[0.0] * 5,
        k=pinhole.matrix.ravel(),
        r=np.eye(3).ravel(),
        p=np.hstack([pinhole.matrix, np.zeros((3, 1))]).ravel(),
    )
    info.header.frame_id = frame
    return info


def _image(pinhole: Pinhole, frame: str, encoding: str, pixel_bytes: int) -> Image:
    """Return a message with black pixels."""
    step = pinhole.width_px * pixel_bytes
    image = Image(
        width=pinhole.width_px,
        height=pinhole.height_px,
        encoding=encoding,
        step=step,
        # Only an array is taken as it is; each byte of anything else is checked.
        data=array('B', bytes(step * pinhole.height_px)),
    )
    image.header.frame_id = frame
    return image
