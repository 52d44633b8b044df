# SPDX-License-Identifier: Apache-2.0
"""Panel with the diagnostic status of the components of a robot."""

from __future__ import annotations

from collections.abc import Mapping
import time
from typing import Any, TYPE_CHECKING

from diagnostic_msgs.msg import DiagnosticArray
from robot_console.diagnostics import DiagnosticBook
from robot_console.diagnostics.condition import condition
from robot_console.live import LivePanel, Viewer
from robot_console.namespaces import NAMESPACE
from rviz_common.properties import Number, Topic

if TYPE_CHECKING:
    from robot_console.live.channel import Action

__all__ = ['Diagnostics']

DEPTH = 50


class Diagnostics(LivePanel):
    """What the parts of a robot say about themselves, the worst first."""

    CLASS = 'robot_console/Diagnostics'
    PAGE = 'diagnostics'
    PERIOD_S = 0.5
    PROPERTIES = (
        NAMESPACE,
        Topic(
            'Topic', 'diagnostics', 'Where parts say it.', 'diagnostic_msgs/msg/DiagnosticArray'
        ),
        Number('Stale After', 5.0, 'For how many seconds a part may say nothing.', 0.5, 3600.0),
    )

    def settings(self) -> dict[str, Any]:
        """Return the initial settings of the page."""
        return {'topic': self._topic(), 'stale': self.values['Stale After']}

    def actions(self) -> Mapping[str, Action]:
        """Return the actions that the page may request."""
        return {'choose': self._choose, 'forget': self._forget}

    def begin(self) -> None:
        """Subscribe to diagnostics, which records changes also without viewers."""
        self._book = DiagnosticBook(self.values['Stale After'])
        self._told: Any = None
        self._ear = self.context.node.create_subscription(
            DiagnosticArray, self._topic(), self._take, DEPTH
        )

    def greet(self, viewer: Viewer) -> None:
        """
        Send the components and their levels to a new viewer.

        Parameters
        ----------
        viewer
            As for `LivePanel.greet`.

        """
        self._told = self._state()
        viewer.tell(**self._told)

    def refresh(self) -> None:
        """Send the changes to the viewers."""
        if not self.channel.viewers:
            return
        state = self._state()
        if state != self._told:
            self._told = state
            self.channel.tell(**state)
        for viewer in self.channel.viewers:
            if viewer.wish is not None:
                self._tell_details(viewer)

    def end(self) -> None:
        """Destroy the subscription."""
        self.context.node.destroy_subscription(self._ear)

    def _topic(self) -> str:
        return self.full_name(self.values['Topic'])

    def _state(self) -> dict[str, Any]:
        rows = self._book.rows(time.monotonic())
        talking = bool(rows) or self.context.node.count_publishers(self._topic()) > 0
        return {'rows': rows, 'talking': talking, 'left_out': self._book.left_out}

    def _tell_details(self, viewer: Viewer) -> None:
        viewer.tell(details=self._book.details(viewer.wish, time.monotonic()))

    def _choose(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        name = message.get('name')
        viewer.wish = name if isinstance(name, str) else None
        if viewer.wish is not None:
            self._tell_details(viewer)

    def _forget(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        self._book.forget_stale(time.monotonic())

    def _take(self, message: Any) -> None:
        now_s, wall_s = time.monotonic(), time.time()
        for status in message.status:
            values = [(each.key, each.value) for each in status.values]
            said = condition(ord(status.level), status.message, status.hardware_id, values)
            self._book.take(status.name, said, now_s, wall_s)
