# SPDX-License-Identifier: Apache-2.0
"""The delay of messages."""

from __future__ import annotations

from collections import deque
from math import sqrt


class DelayMeter:
    """
    Measures the mean, extremes and standard deviation of the last delays.

    Parameters
    ----------
    window
        The number of delays to keep.

    """

    def __init__(self, window: int) -> None:
        self._delays_s: deque[float] = deque(maxlen=window)
        self._changed = False

    def add(self, delay_s: float) -> None:
        """
        Count a message.

        Parameters
        ----------
        delay_s
            From its header's time stamp to its arrival, in s.

        """
        self._delays_s.append(delay_s)
        self._changed = True

    def report(self) -> str:
        """Return the two lines of a report, or '' without new messages since the last one."""
        if not self._changed:
            return ''
        self._changed = False
        delays = self._delays_s
        mean = sum(delays) / len(delays)
        spread = sqrt(sum((delay - mean) ** 2 for delay in delays) / len(delays))
        return (
            f'average delay: {mean:.3f}\n\tmin: {min(delays):.3f}s max: {max(delays):.3f}s '
            f'std dev: {spread:.5f}s window: {len(delays)}'
        )
