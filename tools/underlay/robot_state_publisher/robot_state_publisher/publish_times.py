# SPDX-License-Identifier: Apache-2.0
"""When each joint was published last: not more often than the frequency asks for."""

from __future__ import annotations

from collections.abc import Iterable

__all__ = ['PublishTimes']

S = 1_000_000_000
JUMP_NS = S
"""Stamps of several sources may be somewhat out of order; more than this is a new beginning."""
SLACK = 0.1
"""A source with that very frequency is somewhat uneven; it is not to lose every other state."""


class PublishTimes:
    """
    Limits the rate at which joints are published, by the stamps of their states.

    Parameters
    ----------
    frequency_hz
        The highest rate for a joint, in Hz; an interval may be 10 % shorter, as sources are
        uneven.

    """

    def __init__(self, frequency_hz: float) -> None:
        self._interval_ns = round(S / frequency_hz * (1.0 - SLACK))
        self._last_ns: dict[str, int] = {}

    def went_back(self, names: Iterable[str], stamp_ns: int) -> bool:
        """
        Check whether a stamp is more than 1 s before what was published: time has begun anew.

        Parameters
        ----------
        names
            The joints of the state; the one that was published longest ago counts.
        stamp_ns
            The stamp of the state, in ns.

        """
        return stamp_ns < self._oldest(names) - JUMP_NS

    def forget(self) -> None:
        """Begin anew: the next joint states are due, whatever their stamps."""
        self._last_ns.clear()

    def is_due(self, names: Iterable[str], stamp_ns: int) -> bool:
        """
        Check whether one of the joints has not been published for the shortest interval.

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
        Record that joints are published.

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
