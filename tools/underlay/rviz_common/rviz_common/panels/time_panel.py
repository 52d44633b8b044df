# SPDX-License-Identifier: Apache-2.0
"""The ROS time and the wall time."""

from __future__ import annotations

import time

from rviz_common.pace import Pace
from rviz_common.panel import Panel

__all__ = ['TimePanel']


class TimePanel(Panel):
    """The ROS time, the wall time, and the elapsed time of both."""

    CLASS = 'rviz_common/Time'
    UNUSED = ('Experimental', 'SyncMode', 'SyncSource')

    def start(self) -> None:
        """Add the text."""
        self._pace = Pace()
        self._first_ros_s, self._first_wall_s = self._ros_s(), time.time()
        self._text = self.context.gui.add_markdown('')

    def update(self) -> None:
        """Show the time."""
        if not self._pace.is_due():
            return
        ros_s, wall_s = self._ros_s(), time.time()
        if ros_s < self._first_ros_s:  # a simulator has restarted
            self._first_ros_s = ros_s
        self._text.content = (
            '| | Time | Elapsed |\n|---|---|---|\n'
            f'| ROS | {ros_s:.2f} | {ros_s - self._first_ros_s:.2f} |\n'
            f'| Wall | {wall_s:.2f} | {wall_s - self._first_wall_s:.2f} |'
        )

    def _ros_s(self) -> float:
        return float(self.context.node.get_clock().now().nanoseconds / 1e9)
