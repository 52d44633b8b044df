# SPDX-License-Identifier: Apache-2.0
"""Detection of a real-time factor that stays too low."""

from __future__ import annotations

from dataclasses import dataclass

SLOW_SHARE = 0.9
PATIENCE_S = 5.0


@dataclass(frozen=True)
class Speed:
    """Real-time factors: seconds of the robots' time per second of real time."""

    reached: float
    wanted: float
    """0 is as fast as possible: nothing is too slow then."""

    @property
    def is_slow(self) -> bool:
        """Whether less than 90 % of the wanted factor is reached."""
        return self.reached < SLOW_SHARE * self.wanted


class Slowness:
    """Detector of a computer that stays too busy, which ignores short delays."""

    def __init__(self) -> None:
        self._since_s: float | None = None

    def complaint(self, speed: Speed | None, now_s: float) -> str:
        """
        Return the message about a computer that is too busy; '' if it is not.

        Parameters
        ----------
        speed
            The real-time factors; None while they are not known, as in a pause.
        now_s
            Time of a steady clock.

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
