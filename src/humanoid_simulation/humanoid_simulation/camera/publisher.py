# SPDX-License-Identifier: Apache-2.0
"""The topics of one camera, and their messages."""

from __future__ import annotations

from array import array
from typing import Any

from builtin_interfaces.msg import Time
from humanoid_common.qos import STATE
from humanoid_simulation.camera.images import Cloud, Color, Depth
from humanoid_simulation.camera.pinhole import Pinhole, Wanted
import numpy as np
from numpy.typing import NDArray
from rclpy.node import Node
from sensor_msgs.msg import CameraInfo, Image, PointCloud2, PointField

_NANOSECONDS = 1_000_000_000
_FLOAT_BYTES = 4


class CameraPublisher:
    """
    Publishes colour and depth below `camera`, a `camera_info` beside each, and `points`.

    All of them are reliable: otherwise a large message is lost with any of its fragments.

    Parameters
    ----------
    node
        The node that publishes.
    folder
        Prefix of the topic names: '' or the name of a robot and a slash.
    pinhole
        Image size and field of view of the camera.
    frame
        The optical frame of images and points, for their headers.

    """

    def __init__(self, node: Node, folder: str, pinhole: Pinhole, frame: str) -> None:
        base = f'{folder}camera'
        self._color = node.create_publisher(Image, f'{base}/image_raw', STATE)
        self._depth = node.create_publisher(Image, f'{base}/depth/image_raw', STATE)
        self._color_info = node.create_publisher(CameraInfo, f'{base}/camera_info', STATE)
        self._depth_info = node.create_publisher(CameraInfo, f'{base}/depth/camera_info', STATE)
        self._cloud = node.create_publisher(PointCloud2, f'{folder}points', STATE)
        self._color_image = color_image(pinhole, frame)
        self._depth_image = depth_image(pinhole, frame)
        self._point_cloud = point_cloud(pinhole, frame)
        self._info = camera_info(pinhole, frame)

    def wanted(self) -> Wanted:
        """Check which images, and whether the point cloud, have subscribers."""
        return Wanted(
            color=self._color.get_subscription_count() > 0,
            depth=self._depth.get_subscription_count() > 0,
            cloud=self._cloud.get_subscription_count() > 0,
        )

    @property
    def subscribers(self) -> int:
        """Return the number of subscribers to the images and the point cloud."""
        publishers = self._color, self._depth, self._cloud
        return sum(each.get_subscription_count() for each in publishers)

    def publish(
        self, wanted: Wanted, color: Color, depth: Depth, cloud: Cloud, stamp: Time
    ) -> None:
        """
        Publish the wanted images and the point cloud with one time stamp.

        Parameters
        ----------
        wanted
            Which of the following to publish.
        color, depth, cloud
            The images and the cloud; those that are not wanted are not read.
        stamp
            The time of the state that they show.

        """
        if wanted.color:
            fill_data(self._color_image, color, stamp)
            self._color.publish(self._color_image)
        if wanted.depth:
            fill_data(self._depth_image, depth, stamp)
            self._depth.publish(self._depth_image)
        if wanted.cloud:
            fill_data(self._point_cloud, cloud, stamp)
            self._cloud.publish(self._point_cloud)

    def publish_info(self, stamp: Time) -> None:
        """
        Publish the camera info on those of its two topics that have subscribers.

        Parameters
        ----------
        stamp
            The stamp of the images that it belongs to.

        """
        self._info.header.stamp = stamp
        for publisher in (self._color_info, self._depth_info):
            if publisher.get_subscription_count() > 0:
                publisher.publish(self._info)


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
