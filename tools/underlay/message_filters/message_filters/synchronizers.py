# SPDX-License-Identifier: Apache-2.0
"""Sets of messages that belong together, one of each filter."""

# ruff: noqa: N802
from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from threading import Lock
from typing import Any

from message_filters.simple_filter import SimpleFilter
from message_filters.stamps import stamp_ns

__all__ = ['ApproximateTimeSynchronizer', 'TimeSynchronizer']

_SECOND_NS = 1_000_000_000


class TimeSynchronizer(SimpleFilter):
    """
    Filter that puts out messages of several filters with exactly the same time stamp.

    The registered functions get one message of each filter, in the order of the filters.

    Parameters
    ----------
    fs
        The filters.
    queue_size
        How many messages of each filter wait for the others; the oldest are dropped.

    """

    allow_headerless = False

    def __init__(self, fs: Sequence[SimpleFilter], queue_size: int) -> None:
        super().__init__()
        self.queue_size = queue_size
        self.lock = Lock()
        self.queues: list[dict[int, Any]] = []
        self.connectInput(fs)

    def connectInput(self, fs: Sequence[SimpleFilter]) -> None:
        """
        Synchronize the messages of some filters, with empty queues.

        Parameters
        ----------
        fs
            The filters.

        """
        self.queues = [{} for _ in fs]
        self._inputs = list(fs)
        self.input_connections = [
            f.registerCallback(self.add, queue, index)
            for index, (f, queue) in enumerate(zip(fs, self.queues, strict=True))
        ]

    @property
    def node(self) -> Any:
        """The node of the first subscriber; None without one."""
        nodes = (getattr(f, 'node', None) for f in self._inputs)
        return next((node for node in nodes if node is not None), None)

    def add(self, msg: Any, my_queue: dict[int, Any], my_queue_index: int | None = None) -> None:
        """
        Take a message, and put out the set that it completes.

        Parameters
        ----------
        msg
            The message.
        my_queue
            The one of `queues` that it belongs to.
        my_queue_index
            The index of that queue.

        """
        stamp = stamp_ns(msg, self, allow_headerless=self.allow_headerless)
        if stamp is None:
            return
        with self.lock:
            my_queue[stamp] = msg
            while len(my_queue) > self.queue_size:
                del my_queue[min(my_queue)]
            stamps = self._matching(stamp, my_queue) if stamp in my_queue else None
            if stamps is None:
                return
            found = [queue.pop(key) for queue, key in zip(self.queues, stamps, strict=True)]
        self.signalMessage(*found)

    def _matching(self, stamp: int, my_queue: dict[int, Any]) -> list[int] | None:
        """Return the time of one message of each queue, for a set with the new message."""
        if all(stamp in queue for queue in self.queues):
            return [stamp] * len(self.queues)
        return None


class ApproximateTimeSynchronizer(TimeSynchronizer):
    """
    Filter that puts out messages of several filters with similar time stamps.

    Of all sets with the new message, the one whose stamps lie closest together is put out.

    Parameters
    ----------
    fs
        The filters.
    queue_size
        How many messages of each filter wait for the others; the oldest are dropped.
    slop
        How far the time stamps of a set may lie apart, in s.
    allow_headerless
        Whether messages without a header take part with the time of their arrival. Otherwise they
        are left out with a warning.

    """

    def __init__(
        self,
        fs: Sequence[SimpleFilter],
        queue_size: int,
        slop: float,
        allow_headerless: bool = False,
    ) -> None:
        self.slop_ns = round(slop * _SECOND_NS)
        super().__init__(fs, queue_size)
        self.allow_headerless = allow_headerless

    @property
    def slop(self) -> float:
        """How far the time stamps of a set may lie apart, in s."""
        return self.slop_ns / _SECOND_NS

    def _matching(self, stamp: int, my_queue: dict[int, Any]) -> list[int] | None:
        near = [
            [stamp] if queue is my_queue else self._near(stamp, queue) for queue in self.queues
        ]
        if not all(near):
            return None
        starts = sorted({key for keys in near for key in keys if key <= stamp}, reverse=True)
        sets = (_set_from(start, near) for start in starts)
        return min((keys for keys in sets if keys and self._fits(keys)), key=_spread, default=None)

    def _near(self, stamp: int, queue: dict[int, Any]) -> list[int]:
        return sorted(key for key in queue if abs(key - stamp) <= self.slop_ns)

    def _fits(self, stamps: list[int]) -> bool:
        return _spread(stamps) <= self.slop_ns


def _set_from(start: int, near: list[list[int]]) -> list[int] | None:
    """Return the first time of each sorted list that is not before the start."""
    places = [bisect_left(keys, start) for keys in near]
    if any(place == len(keys) for place, keys in zip(places, near, strict=True)):
        return None
    return [keys[place] for place, keys in zip(places, near, strict=True)]


def _spread(stamps: list[int]) -> int:
    return max(stamps) - min(stamps)
