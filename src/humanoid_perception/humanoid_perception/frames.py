# SPDX-License-Identifier: Apache-2.0
"""Select the camera images to process, and pair them with depth images."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
import math
import struct

__all__ = ['FramePairs', 'RgbdFrame', 'stamp_in']

_KEPT = 4
_BACK_S = 0.5
"""Stamps that go back further mean that the simulation was reset."""
_DUE_EARLY_S = 0.005
_DEPTH_WAIT_S = 0.3
"""How long an image waits for its depth, in wall-clock time."""
_DEPTH_GONE_S = 1.0
"""Time without any depth after which images no longer wait for it."""


@dataclass(frozen=True)
class RgbdFrame:
    """An image to process and its depth, as serialized messages."""

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
    Synchronizer that pairs images with depth, and drops images above a maximum rate.

    Parameters
    ----------
    period_s
        The least difference between the stamps of images.
    max_offset_s
        The largest difference between the stamps of an image and its depth.

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
        """Drop all received images."""
        self._colors.clear()
        self._depths.clear()
        self._newest_s = self._taken_s = self._depth_received_s = -math.inf

    def add_color(self, stamp_s: float, data: bytes, now_s: float) -> None:
        """
        Add a received image; one that comes too soon after the last is dropped.

        Parameters
        ----------
        stamp_s
            Its stamp in s. If it goes back by more than 0.5 s, all earlier images are dropped.
        data
            The serialized image.
        now_s
            The time of a steady clock at which it was received.

        """
        if stamp_s < self._newest_s - _BACK_S:
            self.clear()
        if self._depth_received_s == -math.inf:
            self._depth_received_s = now_s  # the first depth may still be on its way
        self._newest_s = max(self._newest_s, stamp_s)
        if self._is_due(stamp_s):
            self._colors.append(_Waiting(stamp_s, now_s, data))

    def add_depth(self, stamp_s: float, data: bytes, now_s: float) -> None:
        """
        Add a received depth image.

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
        Check whether depth was received within the last second, or may still start to arrive.

        Parameters
        ----------
        now_s
            The current time of the same clock as for `add_depth`.

        """
        return now_s - self._depth_received_s < _DEPTH_GONE_S

    def take(self, now_s: float) -> RgbdFrame | None:
        """
        Remove and return the newest image that has its depth, or has waited for it long enough.

        Parameters
        ----------
        now_s
            The current time of the same clock as for `add_color`.

        Returns
        -------
        RgbdFrame
            The image, with its depth if that was received; None if no image is due yet.

        """
        for color in reversed(self._colors):
            depth = self._depth_of(color)
            waited_s = now_s - color.received_s
            if depth or waited_s >= _DEPTH_WAIT_S or not self.has_depth(now_s):
                return self._taken(color, depth)
        return None

    def _depth_of(self, color: _Waiting) -> bytes | None:
        """Return the depth image nearest in time, if it is within the maximum offset."""
        best = min(self._depths, key=lambda each: abs(each.stamp_s - color.stamp_s), default=None)
        if best is None or abs(best.stamp_s - color.stamp_s) > self.max_offset_s:
            return None
        return best.data

    def _taken(self, color: _Waiting, depth: bytes | None) -> RgbdFrame:
        self._taken_s = color.stamp_s
        later = [each for each in self._colors if self._is_due(each.stamp_s)]
        self._colors = deque(later, maxlen=_KEPT)
        return RgbdFrame(color.stamp_s, color.data, depth)

    def _is_due(self, stamp_s: float) -> bool:
        """Whether an image is at least one period after the one that was taken last."""
        after_s = stamp_s - self._taken_s
        return after_s > 0.0 and after_s >= self.period_s - _DUE_EARLY_S


def stamp_in(data: bytes) -> float:
    """
    Read the stamp of a serialized message (CDR) without deserializing it.

    Parameters
    ----------
    data
        A message that starts with a `std_msgs/Header`, such as an image.

    Returns
    -------
    float
        The stamp in s.

    """
    order = '<' if data[1] & 1 else '>'
    seconds, nanoseconds = struct.unpack_from(f'{order}iI', data, 4)
    return float(seconds) + float(nanoseconds) * 1e-9
