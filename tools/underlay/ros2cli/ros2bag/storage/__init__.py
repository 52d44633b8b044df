# SPDX-License-Identifier: Apache-2.0
"""
Recordings on disk: folders of files in the layout of rosbag2, without ROS.

They are written in MCAP, and read in MCAP or SQLite.

Nothing here imports rclpy or messages. Times are in nanoseconds since the epoch.
"""

__all__ = ['BagError']


class BagError(RuntimeError):
    """A recording cannot be read or written; the text is a message for the user."""
