# SPDX-License-Identifier: Apache-2.0
"""How all parts of a robot are, the worst first."""

from __future__ import annotations

from collections import deque
from typing import Any

from robot_console.diagnostics.condition import Condition, ERROR, OK, STALE, WARN

__all__ = ['DiagnosticBook']

RANK = {ERROR: 0, STALE: 1, WARN: 2, OK: 3}
MOST_PARTS = 1000
CHANGES = 20


class _Part:
    """A part of a robot, with what it said and when that was."""

    def __init__(self) -> None:
        """Begin with a part that has not said anything."""
        self.now = Condition(STALE, '')
        self.heard_s = 0.0
        self.changes: deque[tuple[float, int, str]] = deque(maxlen=CHANGES)

    def take(self, said: Condition, now_s: float, wall_s: float) -> None:
        """Take what it says; changes of the level are remembered."""
        if not self.changes or said.level != self.now.level:
            self.changes.append((wall_s, said.level, said.message))
        self.now = said
        self.heard_s = now_s


class DiagnosticBook:
    """
    The newest diagnostic status of each part of a robot, the worst first.

    A part that says nothing for a while is stale. Times are seconds of a steady clock; those of
    changes are of the wall.

    Parameters
    ----------
    stale_s
        After how long without a status a part is stale, in s.

    Attributes
    ----------
    left_out
        How many statuses were dropped because there were too many parts.

    """

    def __init__(self, stale_s: float = 5.0) -> None:
        self._stale_s = stale_s
        self._parts: dict[str, _Part] = {}
        self.left_out = 0

    def take(self, name: str, said: Condition, now_s: float, wall_s: float) -> None:
        """
        Store the status of a part; that of a new one is dropped if there are 1000 parts already.

        Parameters
        ----------
        name
            The name of the part.
        said
            Its status.
        now_s
            When it came, of `time.monotonic`.
        wall_s
            The same moment of `time.time`, for the list of changes of the level.

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
        List all parts, the worst first: errors, stale ones, warnings, and those that are well.

        Parameters
        ----------
        now_s
            The time of `time.monotonic`.

        Returns
        -------
        list of tuple
            Name, level and message of each part; parts of the same level are sorted by name.

        """
        rows = [
            (name, self._level(part, now_s), part.now.message)
            for name, part in self._parts.items()
        ]
        return sorted(rows, key=lambda row: (RANK[row[1]], row[0]))

    def details(self, name: str, now_s: float) -> dict[str, Any] | None:
        """
        Get everything that is known of one part, for the page.

        Parameters
        ----------
        name
            The name of the part.
        now_s
            The time of `time.monotonic`.

        Returns
        -------
        dict or None
            The status with its age in s and the last changes of the level; None for an unknown
            part.

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
        Remove the parts that are stale, and reset `left_out`.

        Parameters
        ----------
        now_s
            The time of `time.monotonic`.

        """
        self._parts = {
            name: part for name, part in self._parts.items() if not self._is_stale(part, now_s)
        }
        self.left_out = 0

    def _level(self, part: _Part, now_s: float) -> int:
        return STALE if self._is_stale(part, now_s) else part.now.level

    def _is_stale(self, part: _Part, now_s: float) -> bool:
        return now_s - part.heard_s > self._stale_s
