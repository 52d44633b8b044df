# SPDX-License-Identifier: Apache-2.0
"""Buffer of time-stamped values."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

__all__ = ['Numbers', 'Trace']

Numbers = npt.NDArray[np.float64]
FIRST_CAPACITY = 256
MAX_CAPACITY = 1 << 17
"""Sufficient for more than a minute of a topic at 1000 Hz."""


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
