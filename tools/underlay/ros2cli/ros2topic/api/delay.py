# SPDX-License-Identifier: Apache-2.0
"""The delay of messages."""

from __future__ import annotations

from collections import deque
from math import sqrt


class DelayMeter:
    """Keeps the last delays and reports their average, extremes and spread."""

    def __init__(self, window: int) -> None:
        """Keep up to `window` delays."""
        self._delays_s: deque[float] = deque(maxlen=window)
        self._changed = False

    def add(self, delay_s: float) -> None:
        """Count a message."""
        self._delays_s.append(delay_s)
        self._changed = True

    def report(self) -> str:
        """Return the two lines of a report, or '' if nothing has come since the last one."""
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
