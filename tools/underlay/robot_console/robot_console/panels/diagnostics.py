# SPDX-License-Identifier: Apache-2.0
"""Panel with the diagnostic status of the components of a robot, sorted by severity."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
import time
from typing import Any, NamedTuple

from diagnostic_msgs.msg import DiagnosticArray
from robot_console.live_panel import LivePanel
from robot_console.namespaces import NAMESPACE
from rviz_common.page.channel import Action, Viewer
from rviz_common.properties import Number, Topic

__all__ = [
    'ERROR',
    'OK',
    'STALE',
    'WARN',
    'Condition',
    'DiagnosticBook',
    'Diagnostics',
    'condition',
]

OK, WARN, ERROR, STALE = range(4)
LONGEST = 500
MOST_VALUES = 200

RANK = {ERROR: 0, STALE: 1, WARN: 2, OK: 3}
MOST_PARTS = 1000
CHANGES = 20

DEPTH = 50


class Condition(NamedTuple):
    """Diagnostic status of a component, with a level of diagnostic_msgs."""

    level: int
    message: str
    hardware: str = ''
    values: tuple[tuple[str, str], ...] = ()


def condition(level: int, message: str, hardware: str, values: list[tuple[str, str]]) -> Condition:
    """
    Convert a diagnostic status to a `Condition`, truncating long texts.

    Parameters
    ----------
    level
        The level of diagnostic_msgs, from `OK` to `STALE`; any other counts as `ERROR`.
    message
        The message of the component.
    hardware
        The hardware id.
    values
        Key-value pairs; only the first 200 are kept.

    """
    if level not in (OK, WARN, ERROR, STALE):
        message = f'{message} (invalid level {level})'.strip()
        level = ERROR
    pairs = [(_short(key), _short(value)) for key, value in values[:MOST_VALUES]]
    if len(values) > MOST_VALUES:
        pairs.append(('...', f'{len(values) - MOST_VALUES} more values'))
    return Condition(level, _short(message), _short(hardware), tuple(pairs))


def _short(text: str) -> str:
    return text if len(text) <= LONGEST else f'{text[:LONGEST]} ...'


class _Part:
    """A component of a robot, with its latest status and the changes of its level."""

    def __init__(self) -> None:
        """Initialise a component without a status."""
        self.now = Condition(STALE, '')
        self.heard_s = 0.0
        self.changes: deque[tuple[float, int, str]] = deque(maxlen=CHANGES)

    def take(self, said: Condition, now_s: float, wall_s: float) -> None:
        """Store a status, and record a change of the level."""
        if not self.changes or said.level != self.now.level:
            self.changes.append((wall_s, said.level, said.message))
        self.now = said
        self.heard_s = now_s


class DiagnosticBook:
    """
    The latest diagnostic status of each component of a robot, sorted by severity.

    A component without a recent status is stale. Times are in seconds of a monotonic clock; those
    of level changes are wall time.

    Parameters
    ----------
    stale_s
        The time without a status after which a component is stale, in s.

    Attributes
    ----------
    left_out
        The number of statuses that were dropped because there were too many components.

    """

    def __init__(self, stale_s: float = 5.0) -> None:
        self._stale_s = stale_s
        self._parts: dict[str, _Part] = {}
        self.left_out = 0

    def take(self, name: str, said: Condition, now_s: float, wall_s: float) -> None:
        """
        Store the status of a component; new components are dropped once there are 1000.

        Parameters
        ----------
        name
            The name of the component.
        said
            Its status.
        now_s
            The time of reception, from `time.monotonic`.
        wall_s
            The same time from `time.time`, for the history of level changes.

        """
        part = self._parts.get(name)
        if part is None:
            if len(self._parts) >= MOST_PARTS:
                self.left_out += 1
                return
            part = self._parts[name] = _Part()
        part.take(said, now_s, wall_s)

    def rows(self, now_s: float) -> list[tuple[str, int, str]]:
        """
        List all components, sorted by severity: errors, stale, warnings, OK.

        Parameters
        ----------
        now_s
            The current time, from `time.monotonic`.

        Returns
        -------
        list of tuple
            Name, level and message of each component; components of the same level are sorted by
            name.

        """
        rows = [
            (name, self._level(part, now_s), part.now.message)
            for name, part in self._parts.items()
        ]
        return sorted(rows, key=lambda row: (RANK[row[1]], row[0]))

    def details(self, name: str, now_s: float) -> dict[str, Any] | None:
        """
        Return the details of one component, for the page.

        Parameters
        ----------
        name
            The name of the component.
        now_s
            The current time, from `time.monotonic`.

        Returns
        -------
        dict or None
            The status with its age in s and the last level changes; None for an unknown component.

        """
        part = self._parts.get(name)
        if part is None:
            return None
        return {
            'name': name,
            'level': self._level(part, now_s),
            'said': part.now.level,
            'message': part.now.message,
            'hardware': part.now.hardware,
            'values': part.now.values,
            'age': round(now_s - part.heard_s, 1),
            'changes': list(part.changes),
        }

    def forget_stale(self, now_s: float) -> None:
        """
        Remove stale components, and reset `left_out`.

        Parameters
        ----------
        now_s
            The current time, from `time.monotonic`.

        """
        self._parts = {
            name: part for name, part in self._parts.items() if not self._is_stale(part, now_s)
        }
        self.left_out = 0

    def _level(self, part: _Part, now_s: float) -> int:
        return STALE if self._is_stale(part, now_s) else part.now.level

    def _is_stale(self, part: _Part, now_s: float) -> bool:
        return now_s - part.heard_s > self._stale_s


class Diagnostics(LivePanel):
    """What the parts of a robot say about themselves, the worst first."""

    CLASS = 'robot_console/Diagnostics'
    PAGE = 'diagnostics'
    PERIOD_S = 0.5
    PROPERTIES = (
        NAMESPACE,
        Topic(
            'Topic', 'diagnostics', 'The diagnostics topic.', 'diagnostic_msgs/msg/DiagnosticArray'
        ),
        Number('Stale After', 5.0, 'Seconds of silence after which a part is stale.', 0.5, 3600.0),
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
