# SPDX-License-Identifier: Apache-2.0
"""Diagnostic status of all components of a robot, sorted by severity."""

from __future__ import annotations

from collections import deque
from typing import Any

from robot_console.diagnostics.condition import Condition, ERROR, OK, STALE, WARN

__all__ = ['DiagnosticBook']

RANK = {ERROR: 0, STALE: 1, WARN: 2, OK: 3}
MOST_PARTS = 1000
CHANGES = 20


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
