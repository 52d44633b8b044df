# SPDX-License-Identifier: Apache-2.0
"""Decide whether the robot must hold still."""

from __future__ import annotations

PRESSED = 'the emergency stop is pressed'


class StopGuard:
    """
    Decide whether the robot must hold still, and know why.

    There are two reasons: somebody pressed the emergency stop, or the console that was in control
    is gone. Both last until the emergency stop is released, which is for a person to do.

    Parameters
    ----------
    heartbeat_timeout_s
        How long a console in control may be silent, in real time.

    """

    def __init__(self, heartbeat_timeout_s: float) -> None:
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
        """
        Handle a message of the emergency stop.

        Parameters
        ----------
        stop
            True stops the robot. False releases it, also after the console was lost.

        """
        self._reason = PRESSED if stop else ''

    def heartbeat(self, in_control: bool) -> None:
        """
        Handle a heartbeat of a console, which restarts the timeout.

        Parameters
        ----------
        in_control
            Whether the console controls the robot; only then does it have to go on beating.

        """
        self._in_control = in_control
        self._silent_s = 0.0

    def check(self, now_s: float) -> str:
        """
        Check the heartbeat timeout of the console in control; call it several times per timeout.

        Of the time between two checks no more than half of the timeout counts: after a moment in
        which this computer stood still, what has arrived meanwhile is heard first.

        Parameters
        ----------
        now_s
            Time of a steady clock.

        Returns
        -------
        str
            Why the robot must hold still; empty if it may move.

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
