# SPDX-License-Identifier: Apache-2.0
"""
Recordings on disk: folders of MCAP files in the layout of rosbag2, without ROS.

Nothing here imports rclpy or messages. Times are in nanoseconds since the epoch.
"""

from ros2bag.storage.errors import BagError

__all__ = ['BagError']
