# SPDX-License-Identifier: Apache-2.0
"""Rate limit for the publication of joints."""

from __future__ import annotations

from collections.abc import Iterable

__all__ = ['PublishTimes']

S = 1_000_000_000
JUMP_NS = S
"""Tolerance for out-of-order stamps of several sources; a larger step back is a time jump."""
SLACK = 0.1
"""Tolerance for jitter, so that a source at this frequency does not lose every other state."""


class PublishTimes:
    """
    Limits the rate at which joints are published, by the stamps of their states.

    Parameters
    ----------
    frequency_hz
        The maximum rate for a joint, in Hz; intervals may be 10 % shorter, to tolerate jitter of
        the sources.

    """

    def __init__(self, frequency_hz: float) -> None:
        self._interval_ns = round(S / frequency_hz * (1.0 - SLACK))
        self._last_ns: dict[str, int] = {}

    def went_back(self, names: Iterable[str], stamp_ns: int) -> bool:
        """
        Check whether a stamp is more than 1 s older than the published one: time has jumped back.

        Parameters
        ----------
        names
            The joints of the state; the least recently published one is decisive.
        stamp_ns
            The stamp of the state, in ns.

        """
        return stamp_ns < self._oldest(names) - JUMP_NS

    def forget(self) -> None:
        """Reset the rate limit; the next joint states are due, whatever their stamps."""
        self._last_ns.clear()

    def is_due(self, names: Iterable[str], stamp_ns: int) -> bool:
        """
        Check whether the minimum interval has elapsed for at least one of the joints.

        Parameters
        ----------
        names
            The joints of the state.
        stamp_ns
            The stamp of the state, in ns; a state without a stamp (0) is never due.

        """
        return stamp_ns - self._oldest(names) >= self._interval_ns

    def note(self, names: Iterable[str], stamp_ns: int) -> None:
        """
        Record the publication of joints.

        Parameters
        ----------
        names
            The joints.
        stamp_ns
            The stamp of their state, in ns.

        """
        self._last_ns.update(dict.fromkeys(names, stamp_ns))

    def _oldest(self, names: Iterable[str]) -> int:
        last_ns = self._last_ns
        return min((last_ns.get(name, 0) for name in names), default=0)
