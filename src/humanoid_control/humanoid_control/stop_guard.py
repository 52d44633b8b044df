# SPDX-License-Identifier: Apache-2.0
"""Decide whether the robot must hold still."""

from __future__ import annotations

PRESSED = 'the emergency stop is pressed'


class StopGuard:
    """
    Knows why the robot must hold still, if it must.

    There are two reasons: somebody pressed the emergency stop, or the console that was in control
    is gone. Both last until the emergency stop is released, which is for a person to do.
    """

    def __init__(self, heartbeat_timeout_s: float) -> None:
        """Set for how long a console in control may be silent; nothing is wrong yet."""
        self.heartbeat_timeout_s = heartbeat_timeout_s
        self._reason = ''
        self._in_control = False
        self._silent_s = 0.0
        self._checked_s: float | None = None

    @property
    def reason(self) -> str:
        """Return why the robot must hold still, or nothing if it may move."""
        return self._reason

    def order(self, stop: bool) -> None:
        """Take what was said on the topic of the emergency stop."""
        self._reason = PRESSED if stop else ''

    def heartbeat(self, in_control: bool) -> None:
        """Take a sign of life of a console, which says whether it is in control."""
        self._in_control = in_control
        self._silent_s = 0.0

    def check(self, now_s: float) -> str:
        """
        Look for a console that is gone, and return the reason to hold still, if there is one.

        Of the time between two checks no more than half of the timeout counts: after a moment in
        which this computer stood still, what has arrived meanwhile is heard first.
        """
        if self._checked_s is not None:
            elapsed_s = now_s - self._checked_s
            self._silent_s += min(elapsed_s, self.heartbeat_timeout_s / 2)
        self._checked_s = now_s
        if self._in_control and self._silent_s >= self.heartbeat_timeout_s:
            self._in_control = False
            self._reason = self._reason or self._gone()
        return self._reason

    def _gone(self) -> str:
        """Return the sentence on a console that is gone."""
        return (
            'the console that was in control is gone, without a heartbeat for '
            f'{self.heartbeat_timeout_s:g} s'
        )
