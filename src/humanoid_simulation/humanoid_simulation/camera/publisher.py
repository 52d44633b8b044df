# SPDX-License-Identifier: Apache-2.0
"""The topics of one camera."""

from __future__ import annotations

from builtin_interfaces.msg import Time
from humanoid_common.qos import STATE
from humanoid_simulation.camera.conversions import (
    camera_info,
    color_image,
    depth_image,
    fill_data,
    point_cloud,
)
from humanoid_simulation.camera.painter import Cloud, Color, Depth
from humanoid_simulation.camera.pinhole import Pinhole
from humanoid_simulation.camera.view import Wanted
from rclpy.node import Node
from sensor_msgs.msg import CameraInfo, Image, PointCloud2


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
