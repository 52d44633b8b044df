# SPDX-License-Identifier: Apache-2.0
"""
How plotted values are buffered, and decimated to the resolution of a plot.

Time is divided into slices, and the minimum and maximum of each slice are kept, so that no peak is
lost. The slices are the same for all series of a plot and start at multiples of their length;
otherwise, scrolling curves would jitter.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

__all__ = ['SLICES', 'Numbers', 'Trace', 'slice_times', 'thinned']

Numbers = npt.NDArray[np.float64]
FIRST_CAPACITY = 256
MAX_CAPACITY = 1 << 17
"""Sufficient for more than a minute of a topic at 1000 Hz."""

SLICES = 400
PAUSE_S = 1.0
PAUSE_PERIODS = 4.0


class Trace:
    """
    Buffer of the values of the last seconds with their times; older values are dropped.

    Two arrays are filled from the left. When they are full, the values that are still needed are
    moved to the start, or to larger arrays. Therefore, appending is fast, and reading needs no
    copy.

    Parameters
    ----------
    keep_s
        The duration for which values are kept, in s; shorter at high rates, but at least the last
        65,536 values.

    """

    def __init__(self, keep_s: float) -> None:
        self.keep_s = keep_s
        self._times = np.empty(FIRST_CAPACITY)
        self._values = np.empty(FIRST_CAPACITY)
        self._end = 0

    def add(self, time_s: float, value: float) -> None:
        """
        Append a value.

        Parameters
        ----------
        time_s
            Its time, in s. If it precedes the last one by less than `keep_s`, the last time is
            used instead; a larger jump back in time clears the trace first.
        value
            The number, which may be NaN.

        """
        if self._end and time_s < self._times[self._end - 1]:
            if self._times[self._end - 1] - time_s < self.keep_s:
                time_s = float(self._times[self._end - 1])
            else:
                self._end = 0
        if self._end == len(self._times):
            self._make_room(time_s - self.keep_s)
        self._times[self._end] = time_s
        self._values[self._end] = value
        self._end += 1

    def clear(self) -> None:
        """Clear all values."""
        self._end = 0

    @property
    def newest(self) -> float | None:
        """Return the latest value, if there is one."""
        return float(self._values[self._end - 1]) if self._end else None

    def since(self, first_s: float) -> tuple[Numbers, Numbers]:
        """
        Return the values from a time on, and the value before it.

        Parameters
        ----------
        first_s
            The time, in s.

        Returns
        -------
        tuple
            Times (n,) and values (n,), as views that the next `add` may overwrite.

        """
        start = max(int(np.searchsorted(self._times[: self._end], first_s)) - 1, 0)
        seen = slice(start, self._end)
        return self._times[seen], self._values[seen]

    def _make_room(self, oldest_s: float) -> None:
        start = int(np.searchsorted(self._times, oldest_s))
        capacity = len(self._times)
        kept = capacity - start
        if kept > capacity // 2:
            if capacity < MAX_CAPACITY:
                capacity *= 2
            else:
                start, kept = capacity // 2, capacity // 2
        times, values = np.empty(capacity), np.empty(capacity)
        wanted = slice(start, start + kept)
        times[:kept], values[:kept] = self._times[wanted], self._values[wanted]
        self._times, self._values, self._end = times, values, kept


def slice_times(window_s: float) -> Numbers:
    """
    Compute the times of the drawn points, two per slice.

    Parameters
    ----------
    window_s
        The length of the time window, in s.

    Returns
    -------
    Numbers
        Times (800,) in s relative to now, from `-window_s` to 0.

    """
    return np.linspace(-window_s, 0.0, 2 * SLICES, dtype=np.float64)


def thinned(times: Numbers, values: Numbers, now_s: float, window_s: float) -> Numbers:
    """
    Resample a trace to the times of the slices, keeping the extremes of each slice.

    The curve has a gap at non-finite values, and where no value was received for a second and for
    much longer than the mean period. Other values are interpolated linearly.

    Parameters
    ----------
    times, values
        The trace (n,), its times ascending, in s.
    now_s
        The time at the right end of the plot, of the same clock.
    window_s
        The length of the time window, in s.

    Returns
    -------
    Numbers
        Values (800,) for the times of `slice_times`; NaN where the curve has a gap.

    """
    finite = np.flatnonzero(np.isfinite(values))
    if len(finite) == 0:
        return np.full(2 * SLICES, np.nan)
    slice_s = window_s / SLICES
    first = math.floor(now_s / slice_s) - SLICES + 1
    at_s = (first + (np.arange(2 * SLICES) + 0.5) / 2.0) * slice_s
    known_s, known = times[finite], values[finite]
    drawn: Numbers = np.interp(at_s, known_s, known, left=np.nan, right=np.nan)
    is_gap = (np.diff(finite) > 1) | (np.diff(known_s) > _longest_s(times))
    after = np.searchsorted(known_s, at_s)
    drawn[np.concatenate(([False], is_gap, [False]))[after]] = np.nan
    _fill(drawn, np.floor(known_s / slice_s).astype(np.int64) - first, known)
    return drawn


def _longest_s(times: Numbers) -> float:
    """Compute the longest interval between values that is not a gap."""
    if len(times) < 2:
        return PAUSE_S
    return max(PAUSE_S, PAUSE_PERIODS * float(times[-1] - times[0]) / (len(times) - 1))


def _fill(drawn: Numbers, places: npt.NDArray[np.int64], values: Numbers) -> None:
    """Set the minimum and maximum of each slice that contains values."""
    inside = (places >= 0) & (places < SLICES)
    places, values = places[inside], values[inside]
    if len(places) == 0:
        return
    starts = np.flatnonzero(np.diff(places, prepend=-1))
    low, high = np.minimum.reduceat(values, starts), np.maximum.reduceat(values, starts)
    ends = np.append(starts[1:], len(values)) - 1
    rises = values[ends] >= values[starts]
    at = 2 * places[starts]
    drawn[at] = np.where(rises, low, high)
    drawn[at + 1] = np.where(rises, high, low)
