# SPDX-License-Identifier: Apache-2.0
"""Convert images, point clouds and the geometry of a camera to messages."""

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
    """
    Convert nanoseconds to a ROS time stamp.

    Parameters
    ----------
    time_ns
        Time since the epoch of the clock, in ns.

    """
    seconds, nanoseconds = divmod(time_ns, _NANOSECONDS)
    return Time(sec=seconds, nanosec=nanoseconds)


def color_image(pinhole: Pinhole, frame: str) -> Image:
    """
    Create a black rgb8 image message, to be reused for each colour image.

    Parameters
    ----------
    pinhole
        The camera, which determines the size.
    frame
        Its optical frame (`frame_id`).

    """
    return _image(pinhole, frame, 'rgb8', 3)


def depth_image(pinhole: Pinhole, frame: str) -> Image:
    """
    Create an empty 32FC1 image message, to be reused for each depth image in m.

    Parameters
    ----------
    pinhole
        The camera, which determines the size.
    frame
        Its optical frame (`frame_id`).

    """
    return _image(pinhole, frame, '32FC1', 4)


def point_cloud(pinhole: Pinhole, frame: str) -> PointCloud2:
    """
    Create an organised point cloud message, to be reused for each cloud.

    Its fields are x, y and z as float32, in m. It is not dense: points may be NaN.

    Parameters
    ----------
    pinhole
        The camera: the cloud has one point for each of its pixels.
    frame
        Its optical frame (`frame_id`).

    """
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
    """
    Copy an image or a point cloud into a preallocated message.

    Parameters
    ----------
    message
        A message from `color_image`, `depth_image` or `point_cloud`.
    values
        Pixels or points, with as many bytes as the message has: uint8 for colours, else float32.
    stamp
        When the image was taken.

    """
    np.frombuffer(message.data, np.uint8)[:] = values.reshape(-1).view(np.uint8)
    message.header.stamp = stamp


def camera_info(pinhole: Pinhole, frame: str) -> CameraInfo:
    """
    Describe a pinhole camera without distortion, whose image is already rectified.

    Parameters
    ----------
    pinhole
        The camera.
    frame
        Its optical frame (`frame_id`).

    Returns
    -------
    CameraInfo
        Distortion model plumb_bob with zero coefficients; the stamp is not set.

    """
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
    """Create an image message with black pixels."""
    step = pinhole.width_px * pixel_bytes
    image = Image(
        width=pinhole.width_px,
        height=pinhole.height_px,
        encoding=encoding,
        step=step,
        # Only an array is used as it is; of any other type, each byte is checked.
        data=array('B', bytes(step * pinhole.height_px)),
    )
    image.header.frame_id = frame
    return image
