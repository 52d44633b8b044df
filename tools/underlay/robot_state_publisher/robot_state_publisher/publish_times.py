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
    """Decides by the stamps of joint states which of them are due."""

    def __init__(self, frequency_hz: float) -> None:
        """Have published nothing yet."""
        self._interval_ns = round(S / frequency_hz * (1.0 - SLACK))
        self._last_ns: dict[str, int] = {}

    def went_back(self, names: Iterable[str], stamp_ns: int) -> bool:
        """Tell if a stamp is far before what was published: time has begun anew."""
        return stamp_ns < self._oldest(names) - JUMP_NS

    def forget(self) -> None:
        """Begin anew: the next joint states are due, whatever their stamps."""
        self._last_ns.clear()

    def is_due(self, names: Iterable[str], stamp_ns: int) -> bool:
        """Tell if one of the joints has waited long enough; one without a stamp never has."""
        return stamp_ns - self._oldest(names) >= self._interval_ns

    def note(self, names: Iterable[str], stamp_ns: int) -> None:
        """Note that these joints are published."""
        self._last_ns.update(dict.fromkeys(names, stamp_ns))

    def _oldest(self, names: Iterable[str]) -> int:
        last_ns = self._last_ns
        return min((last_ns.get(name, 0) for name in names), default=0)
