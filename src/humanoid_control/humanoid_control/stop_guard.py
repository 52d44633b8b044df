# SPDX-License-Identifier: Apache-2.0
"""Stop logic: emergency stop, and heartbeat watchdog of the console in control."""

from __future__ import annotations

PRESSED = 'the emergency stop is pressed'


class StopGuard:
    """
    Watchdog that decides whether the robot must hold still, and why.

    There are two reasons: the emergency stop was pressed, or the console in control was lost. Both
    last until a person releases the emergency stop.

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
        """Return the reason why the robot must hold still; empty if it may move."""
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
            Whether the console controls the robot; only then are further heartbeats required.

        """
        self._in_control = in_control
        self._silent_s = 0.0

    def check(self, now_s: float) -> str:
        """
        Check the heartbeat timeout of the console in control; call it several times per timeout.

        The time between two checks counts for at most half of the timeout: when this computer
        stalled, messages that have arrived meanwhile are handled first.

        Parameters
        ----------
        now_s
            Time of a steady clock.

        Returns
        -------
        str
            The reason why the robot must hold still; empty if it may move.

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
        """Build the message about a lost console."""
        return (
            'the console that was in control is gone, without a heartbeat for '
            f'{self.heartbeat_timeout_s:g} s'
        )
