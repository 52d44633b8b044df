# SPDX-License-Identifier: Apache-2.0
"""The display of point clouds from depth cameras, lidars and the like."""

from __future__ import annotations

from typing import Any

from rviz_common.properties import topic_properties
from rviz_default_plugins.decoding.cloud import Cloud
from rviz_default_plugins.decoding.point_cloud import decode_cloud
from rviz_default_plugins.displays.clouds import CLOUD, CloudDisplay
from sensor_msgs.msg import PointCloud2 as PointCloud2Message

__all__ = ['PointCloud2']


class PointCloud2(CloudDisplay):
    """The last clouds of a topic."""

    CLASS = 'rviz_default_plugins/PointCloud2'
    MESSAGE = PointCloud2Message
    PROPERTIES = (*topic_properties('sensor_msgs/msg/PointCloud2', '/points'), *CLOUD)

    def decode(self, message: Any) -> Cloud:
        """
        Convert a message to points.

        Parameters
        ----------
        message
            As for `CloudDisplay.decode`.

        """
        return decode_cloud(message)
