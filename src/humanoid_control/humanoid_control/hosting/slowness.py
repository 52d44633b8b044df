# SPDX-License-Identifier: Apache-2.0
"""Notice that the robots' time passes more slowly than it is to."""

from __future__ import annotations

from dataclasses import dataclass

SLOW_SHARE = 0.9
PATIENCE_S = 5.0


@dataclass(frozen=True)
class Speed:
    """Seconds of the robots' time in a real one: real-time factors."""

    reached: float
    wanted: float
    """0 is as fast as possible: nothing is too slow then."""

    @property
    def is_slow(self) -> bool:
        """Whether less than 90 % of what is wanted is reached."""
        return self.reached < SLOW_SHARE * self.wanted


class Slowness:
    """Tells a computer that is too busy from one that was busy for a moment."""

    def __init__(self) -> None:
        self._since_s: float | None = None

    def complaint(self, speed: Speed | None, now_s: float) -> str:
        """
        Return what is wrong, or '' if nothing is.

        Parameters
        ----------
        speed
            How fast time passes; None while it is not known, as in a pause.
        now_s
            That of a steady clock.

        """
        if speed is None or not speed.is_slow:
            self._since_s = None
            return ''
        if self._since_s is None:
            self._since_s = now_s
        if now_s - self._since_s < PATIENCE_S:
            return ''
        return (
            f'slow: the real-time factor is {speed.reached:.2f} instead of {speed.wanted:g}. '
            'The computer is too busy'
        )
