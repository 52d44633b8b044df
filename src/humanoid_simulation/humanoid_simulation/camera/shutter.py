# SPDX-License-Identifier: Apache-2.0
"""Rate limiter for camera images."""

from __future__ import annotations

_NANOSECONDS = 1_000_000_000
_TINY = 1e-6
"""Tolerance for rounding errors at the start of a period, in periods."""


class Shutter:
    """
    Rate limiter for images on a time grid, so that the mean rate does not depend on the ticks.

    An image that could not be taken in time stays due until it is; those in between are skipped.

    Parameters
    ----------
    rate_hz
        Images per second of simulated time, above 0.

    """

    def __init__(self, rate_hz: float) -> None:
        self._rate_hz = rate_hz
        self._last: int | None = None

    def is_due(self, time_ns: int) -> bool:
        """
        Check whether the period that a time is in has no image yet.

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
        """Return the index of the period that a time is in; exact at the start of periods."""
        return int(time_ns * self._rate_hz / _NANOSECONDS + _TINY)
