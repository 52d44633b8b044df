# SPDX-License-Identifier: Apache-2.0
"""Turn pictures and the geometry of a camera into messages."""

from __future__ import annotations

from array import array
from typing import Any

from builtin_interfaces.msg import Time
from humanoid_simulation.camera.pinhole import Pinhole
import numpy as np
from numpy.typing import NDArray
from sensor_msgs.msg import CameraInfo, Image, PointCloud2, PointField

_NANOSECONDS = 1_000_000_000
_FLOAT_BYTES = 4


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


def point_cloud(pinhole: Pinhole, frame: str) -> PointCloud2:
    """Return a message for organised clouds, x, y, z in metres, to be filled again and again."""
    names = ('x', 'y', 'z')
    point_bytes = _FLOAT_BYTES * len(names)
    row_bytes = pinhole.width_px * point_bytes
    cloud = PointCloud2(
        width=pinhole.width_px,
        height=pinhole.height_px,
        fields=[
            PointField(
                name=name, offset=_FLOAT_BYTES * number, datatype=PointField.FLOAT32, count=1
            )
            for number, name in enumerate(names)
        ],
        is_bigendian=False,
        point_step=point_bytes,
        row_step=row_bytes,
        is_dense=False,
        data=array('B', bytes(row_bytes * pinhole.height_px)),
    )
    cloud.header.frame_id = frame
    return cloud


def fill_data(message: Image | PointCloud2, values: NDArray[Any], stamp: Time) -> None:
    """Put a picture or cloud of the right size into a message."""
    np.frombuffer(message.data, np.uint8)[:] = values.reshape(-1).view(np.uint8)
    message.header.stamp = stamp


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
