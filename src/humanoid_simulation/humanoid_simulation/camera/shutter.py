# SPDX-License-Identifier: Apache-2.0
"""When the next picture is due."""

from __future__ import annotations

_NANOSECONDS = 1_000_000_000
_TINY = 1e-6
"""By so many periods a time may miss the beginning of one, for all that numbers are round."""


class Shutter:
    """
    Rate limiter for images, on a grid, so that the mean rate holds whatever the ticks are.

    An image that could not be taken in time is due until it is; those in between are left out.

    Parameters
    ----------
    rate_hz
        Images in a second of simulated time, above 0.

    """

    def __init__(self, rate_hz: float) -> None:
        self._rate_hz = rate_hz
        self._last: int | None = None

    def is_due(self, time_ns: int) -> bool:
        """
        Check whether no image was taken yet in the period of a time.

        Parameters
        ----------
        time_ns
            Simulated time, in ns.

        """
        return self._period_of(time_ns) != self._last

    def release(self, time_ns: int) -> None:
        """
        Record that an image was taken.

        Parameters
        ----------
        time_ns
            Simulated time of the image, in ns.

        """
        self._last = self._period_of(time_ns)

    def _period_of(self, time_ns: int) -> int:
        """Return the number of the period that a time is in; exact where periods begin."""
        return int(time_ns * self._rate_hz / _NANOSECONDS + _TINY)
