# SPDX-License-Identifier: Apache-2.0
"""When each recorded moment is due."""

from __future__ import annotations

from collections.abc import Callable
import time

__all__ = ['Pacing']


class Pacing:
    """Lays recorded time over the time of the clock on the wall, from now on, at a rate."""

    def __init__(
        self, recorded_ns: int, rate: float, now_ns: Callable[[], int] = time.monotonic_ns
    ) -> None:
        """Start at a recorded moment; the rate may be infinite."""
        self._now_ns = now_ns
        self._rate = rate
        self._anchor_recorded_ns = recorded_ns
        self._anchor_ns = now_ns()
        self._is_held = False

    @property
    def rate(self) -> float:
        """Return how many recorded seconds pass in one."""
        return self._rate

    @property
    def recorded_now_ns(self) -> int:
        """Return the recorded moment that is now."""
        if self._is_held or self._rate == float('inf'):
            return self._anchor_recorded_ns
        elapsed_ns = self._now_ns() - self._anchor_ns
        return self._anchor_recorded_ns + int(elapsed_ns * self._rate)

    def wait_ns(self, recorded_ns: int) -> int:
        """Return how long it is until a recorded moment; below zero if it is over."""
        due_ns = self._anchor_ns + int((recorded_ns - self._anchor_recorded_ns) / self._rate)
        return due_ns - self._now_ns()

    def hold(self) -> None:
        """Let recorded time stand still."""
        if not self._is_held:
            self._anchor_recorded_ns = self.recorded_now_ns
            self._is_held = True

    def release(self) -> None:
        """Let recorded time go on."""
        if self._is_held:
            self._is_held = False
            self._anchor_ns = self._now_ns()

    def jump_to(self, recorded_ns: int) -> None:
        """Go on from another recorded moment."""
        self._anchor_recorded_ns = recorded_ns
        self._anchor_ns = self._now_ns()

    def set_rate(self, rate: float) -> None:
        """Go on at another rate."""
        self.jump_to(self.recorded_now_ns)
        self._rate = rate
