# SPDX-License-Identifier: Apache-2.0
"""The latest messages of a filter, looked up by time."""

# ruff: noqa: N802
from __future__ import annotations

from collections import deque
from threading import Lock
from typing import Any

from message_filters.simple_filter import SimpleFilter
from message_filters.stamps import nanoseconds, stamp_ns
from rclpy.clock import ClockType
from rclpy.time import Time

__all__ = ['Cache']


class Cache(SimpleFilter):
    """
    Filter that passes messages on and keeps the last ones.

    Parameters
    ----------
    f
        The filter whose messages are kept; None for a cache that only `add` fills.
    cache_size
        How many messages are kept, at least 1.
    allow_headerless
        Whether messages without a header are kept with the time of their arrival. Otherwise they
        are left out with a warning.

    """

    def __init__(
        self, f: SimpleFilter | None, cache_size: int = 1, allow_headerless: bool = False
    ) -> None:
        super().__init__()
        self.cache_size = cache_size
        self.allow_headerless = allow_headerless
        self.incoming_connection: int | None = None
        self._input: SimpleFilter | None = None
        self._lock = Lock()
        self._kept: deque[tuple[int, Any]] = deque(maxlen=max(1, cache_size))
        if f is not None:
            self.connectInput(f)

    @property
    def node(self) -> Any:
        """The node of the chain's subscriber; None without one."""
        return getattr(self._input, 'node', None)

    @property
    def cache_msgs(self) -> list[Any]:
        """The kept messages in the order of their arrival."""
        with self._lock:
            return [msg for _, msg in self._kept]

    @property
    def cache_times(self) -> list[Time]:
        """The times of the kept messages in the order of their arrival."""
        with self._lock:
            return [_ros_time(stamp) for stamp, _ in self._kept]

    def connectInput(self, f: SimpleFilter) -> None:
        """
        Keep the messages of a filter.

        Parameters
        ----------
        f
            The filter.

        """
        self._input = f
        self.incoming_connection = f.registerCallback(self.add)

    def add(self, msg: Any) -> None:
        """
        Keep a message, and pass it on.

        Parameters
        ----------
        msg
            The message.

        """
        stamp = stamp_ns(msg, self, allow_headerless=self.allow_headerless)
        if stamp is None:
            return
        with self._lock:
            self._kept.append((stamp, msg))
        self.signalMessage(msg)

    def getInterval(self, from_stamp: Any, to_stamp: Any) -> list[Any]:
        """
        Return the messages of an interval, both ends included.

        Parameters
        ----------
        from_stamp, to_stamp
            Its ends: `rclpy.time.Time` or stamps of messages.

        """
        first, last = nanoseconds(from_stamp), nanoseconds(to_stamp)
        with self._lock:
            return [msg for stamp, msg in self._kept if first <= stamp <= last]

    def getElemAfterTime(self, stamp: Any) -> Any:
        """
        Return the oldest message that is not older than a time; None if there is none.

        Parameters
        ----------
        stamp
            The time: an `rclpy.time.Time` or the stamp of a message.

        """
        limit = nanoseconds(stamp)
        with self._lock:
            later = [entry for entry in self._kept if entry[0] >= limit]
        return min(later, key=_time)[1] if later else None

    def getElemBeforeTime(self, stamp: Any) -> Any:
        """
        Return the newest message that is not newer than a time; None if there is none.

        Parameters
        ----------
        stamp
            The time: an `rclpy.time.Time` or the stamp of a message.

        """
        limit = nanoseconds(stamp)
        with self._lock:
            earlier = [entry for entry in self._kept if entry[0] <= limit]
        return max(earlier, key=_time)[1] if earlier else None

    def getLatestTime(self) -> Time | None:
        """Return the time of the newest message; None if there is none."""
        with self._lock:
            return _ros_time(max(map(_time, self._kept))) if self._kept else None

    getLastestTime = getLatestTime  # noqa: N815  (the spelling of the genuine package)

    def getOldestTime(self) -> Time | None:
        """Return the time of the oldest message; None if there is none."""
        with self._lock:
            return _ros_time(min(map(_time, self._kept))) if self._kept else None

    def getLast(self) -> Any:
        """Return the newest message; None if there is none."""
        with self._lock:
            return max(self._kept, key=_time)[1] if self._kept else None


def _ros_time(stamp_ns: int) -> Time:
    return Time(nanoseconds=stamp_ns, clock_type=ClockType.ROS_TIME)


def _time(entry: tuple[int, Any]) -> int:
    return entry[0]
