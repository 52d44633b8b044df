# SPDX-License-Identifier: Apache-2.0
"""The points of a laser scanner."""

from __future__ import annotations

from typing import Any

from rviz_common.properties import topic_properties
from rviz_default_plugins.decoding.cloud import Cloud
from rviz_default_plugins.decoding.laser_scan import decode_scan
from rviz_default_plugins.displays.clouds import CLOUD, CloudDisplay
from sensor_msgs.msg import LaserScan as LaserScanMessage

__all__ = ['LaserScan']


class LaserScan(CloudDisplay):
    """The last scans of a topic."""

    CLASS = 'rviz_default_plugins/LaserScan'
    MESSAGE = LaserScanMessage
    PROPERTIES = (*topic_properties('sensor_msgs/msg/LaserScan', '/scan'), *CLOUD)

    def decode(self, message: Any) -> Cloud:
        """
        Convert a scan to points.

        Parameters
        ----------
        message
            As for `CloudDisplay.decode`.

        """
        return decode_scan(message)
