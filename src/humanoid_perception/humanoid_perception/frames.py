# SPDX-License-Identifier: Apache-2.0
"""Which pictures of a camera a detector looks at, and which depth image belongs to each."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
import math
import struct

__all__ = ['Frame', 'FramePairs', 'stamp_in']

_KEPT = 4
_BACK_S = 0.5
"""Stamps that go back further mean that the simulation was reset."""
_DUE_EARLY_S = 0.005
_DEPTH_WAIT_S = 0.3
"""How long a picture waits for its depth, by the clock on the wall."""
_DEPTH_GONE_S = 1.0
"""After how long without depth it is not waited for any more."""


@dataclass(frozen=True)
class Frame:
    """A picture to look at, as serialized messages."""

    stamp_s: float
    color: bytes
    depth: bytes | None


@dataclass(frozen=True)
class _Waiting:
    stamp_s: float
    received_s: float
    data: bytes


class FramePairs:
    """
    Pairs pictures with depth, and drops those that come faster than they are wanted.

    Parameters
    ----------
    period_s
        How far apart the stamps of pictures are at least.
    max_offset_s
        How far the stamp of depth may be from that of its picture.

    """

    def __init__(self, period_s: float, max_offset_s: float) -> None:
        self.period_s = period_s
        self.max_offset_s = max_offset_s
        self._colors: deque[_Waiting] = deque(maxlen=_KEPT)
        self._depths: deque[_Waiting] = deque(maxlen=_KEPT)
        self._newest_s = -math.inf
        self._taken_s = -math.inf
        self._depth_received_s = -math.inf

    def clear(self) -> None:
        """Forget everything that was received."""
        self._colors.clear()
        self._depths.clear()
        self._newest_s = self._taken_s = self._depth_received_s = -math.inf

    def add_color(self, stamp_s: float, data: bytes, now_s: float) -> None:
        """
        Take a picture as it was received; one that comes too soon after the last is dropped.

        Parameters
        ----------
        stamp_s
            Its stamp in s. If it goes back by more than 0.5 s, all that came before is dropped.
        data
            The serialized image.
        now_s
            The time of a steady clock at which it was received.

        """
        if stamp_s < self._newest_s - _BACK_S:
            self.clear()
        if self._depth_received_s == -math.inf:
            self._depth_received_s = now_s  # the first depth may be on its way
        self._newest_s = max(self._newest_s, stamp_s)
        if self._is_due(stamp_s):
            self._colors.append(_Waiting(stamp_s, now_s, data))

    def add_depth(self, stamp_s: float, data: bytes, now_s: float) -> None:
        """
        Take a depth image as it was received.

        Parameters
        ----------
        stamp_s
            Its stamp in s.
        data
            The serialized image.
        now_s
            The time of a steady clock at which it was received.

        """
        self._depth_received_s = now_s
        self._depths.append(_Waiting(stamp_s, now_s, data))

    def has_depth(self, now_s: float) -> bool:
        """
        Whether depth came within the last second, or may still come for the first time.

        Parameters
        ----------
        now_s
            The time now, by the same clock as for `add_depth`.

        """
        return now_s - self._depth_received_s < _DEPTH_GONE_S

    def take(self, now_s: float) -> Frame | None:
        """
        Take the newest picture whose depth has come, or has been waited for long enough.

        Parameters
        ----------
        now_s
            The time now, by the same clock as for `add_color`.

        Returns
        -------
        Frame
            The picture, with its depth if that came; None if no picture is due yet.

        """
        for color in reversed(self._colors):
            depth = self._depth_of(color)
            waited_s = now_s - color.received_s
            if depth or waited_s >= _DEPTH_WAIT_S or not self.has_depth(now_s):
                return self._taken(color, depth)
        return None

    def _depth_of(self, color: _Waiting) -> bytes | None:
        """Return the depth that is closest in time, if that is close enough."""
        best = min(self._depths, key=lambda each: abs(each.stamp_s - color.stamp_s), default=None)
        if best is None or abs(best.stamp_s - color.stamp_s) > self.max_offset_s:
            return None
        return best.data

    def _taken(self, color: _Waiting, depth: bytes | None) -> Frame:
        self._taken_s = color.stamp_s
        later = [each for each in self._colors if self._is_due(each.stamp_s)]
        self._colors = deque(later, maxlen=_KEPT)
        return Frame(color.stamp_s, color.data, depth)

    def _is_due(self, stamp_s: float) -> bool:
        """Whether a picture is far enough from the one that was taken last."""
        after_s = stamp_s - self._taken_s
        return after_s > 0.0 and after_s >= self.period_s - _DUE_EARLY_S


def stamp_in(data: bytes) -> float:
    """
    Read the stamp of a serialized message (CDR) without deserializing it.

    Parameters
    ----------
    data
        A message that begins with a `std_msgs/Header`, such as an image.

    Returns
    -------
    float
        The stamp in s.

    """
    order = '<' if data[1] & 1 else '>'
    seconds, nanoseconds = struct.unpack_from(f'{order}iI', data, 4)
    return float(seconds) + float(nanoseconds) * 1e-9
