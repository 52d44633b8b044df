# SPDX-License-Identifier: Apache-2.0
"""Do something now and then, in the robot's time."""

from __future__ import annotations

_ROUNDING_S = 1e-6


class Every:
    """Says when a rate asks for the next time; a rate of zero never does."""

    def __init__(self, rate_hz: float) -> None:
        """Be due at once, the first time."""
        self._period_s = 1.0 / rate_hz if rate_hz > 0.0 else float('inf')
        self._next_s = float('-inf') if rate_hz > 0.0 else float('inf')

    def is_due(self, now_s: float) -> bool:
        """Tell whether it is time; times that were missed are left out, and time may go back."""
        if now_s < self._next_s - self._period_s - _ROUNDING_S:
            self._next_s = now_s
        if now_s < self._next_s - _ROUNDING_S:
            return False
        self._next_s += self._period_s
        if self._next_s <= now_s:
            self._next_s = now_s + self._period_s
        return True
