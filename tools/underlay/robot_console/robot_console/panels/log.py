# SPDX-License-Identifier: Apache-2.0
"""Panel with the log messages of nodes."""

from __future__ import annotations

from collections.abc import Mapping
import time
from typing import Any, TYPE_CHECKING

from rcl_interfaces.msg import Log as LogMessage
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from robot_console.live import LivePanel, Viewer
from robot_console.log import Interruptions, LogBook, LogLine
from robot_console.namespaces import NAMESPACE
from rviz_common.properties import Flag, Topic, Whole

if TYPE_CHECKING:
    from robot_console.live.channel import Action

__all__ = ['Log']

ALL_OF_BEFORE = QoSProfile(
    depth=1000,
    reliability=ReliabilityPolicy.RELIABLE,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
)
SHOWN_S = 10.0


class Log(LivePanel):
    """What nodes say, by level, node and words; errors pop up, whatever is looked at."""

    CLASS = 'robot_console/Log'
    PAGE = 'log'
    PROPERTIES = (
        NAMESPACE,
        Topic('Topic', '/rosout', 'Where nodes say it.', 'rcl_interfaces/msg/Log'),
        Whole('Kept Messages', 500, 'How many messages are kept.', 10, 5000),
        Flag('Pop Up Errors', True, 'Whether an error is shown in all browsers at once.'),
    )

    def settings(self) -> dict[str, Any]:
        """Return the initial settings of the page."""
        return {'topic': self._topic(), 'kept': self.values['Kept Messages']}

    def actions(self) -> Mapping[str, Action]:
        """Return the actions that the page may request."""
        return {'all': lambda viewer, message: self.greet(viewer)}

    def begin(self) -> None:
        """Subscribe to the log, also without viewers."""
        self._book = LogBook(self.values['Kept Messages'], self.values['Namespace'])
        self._interruptions = Interruptions()
        self._told = 0
        self._ear = self.context.node.create_subscription(
            LogMessage, self._topic(), self._take, ALL_OF_BEFORE
        )

    def greet(self, viewer: Viewer) -> None:
        """
        Send all stored lines to a new viewer.

        Parameters
        ----------
        viewer
            As for `LivePanel.greet`.

        """
        self._tell_all()
        viewer.tell(fresh=True, **self._book.news(0))

    def refresh(self) -> None:
        """Send new lines to the viewers, and show notifications of errors."""
        self._tell_all()
        interruption = self._interruptions.due(time.monotonic())
        if interruption and self.values['Pop Up Errors']:
            for client in self.context.server.get_clients().values():
                client.add_notification(*interruption, auto_close_seconds=SHOWN_S, color='red')

    def end(self) -> None:
        """Destroy the subscription."""
        self.context.node.destroy_subscription(self._ear)

    def _topic(self) -> str:
        return self.full_name(self.values['Topic'])

    def _tell_all(self) -> None:
        if self._told != self._book.count and self.channel.viewers:
            self.channel.tell(**self._book.news(self._told))
        self._told = self._book.count

    def _take(self, message: Any) -> None:
        stamp = message.stamp
        where = f'{message.function}() in {message.file}:{message.line}' if message.file else ''
        line = LogLine(
            stamp.sec + stamp.nanosec / 1e9, message.level, message.name, message.msg, where
        )
        kept = self._book.add(line)
        if kept is not None:
            self._interruptions.add(kept, time.monotonic())
