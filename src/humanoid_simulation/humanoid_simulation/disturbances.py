# SPDX-License-Identifier: Apache-2.0
"""What makes it hard for a controller: pushes, ticks that it misses, targets that come late."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
import math

from humanoid_control.backends import Array, JointTargets
import numpy as np

PUSH_S = 0.1


@dataclass(frozen=True, eq=False)
class Push:
    """A level force (3,) that lasts for a while."""

    force_n: Array
    duration_s: float = PUSH_S


def push(impulse_ns: float, direction_rad: float, duration_s: float = PUSH_S) -> Push:
    """Return a push of so many newton seconds, in a direction: 0 is x, a quarter turn is y."""
    direction = np.array([math.cos(direction_rad), math.sin(direction_rad), 0.0])
    return Push(direction * (impulse_ns / duration_s), duration_s)


class RandomPushes:
    """Pushes in random directions, at random moments."""

    def __init__(
        self, random: np.random.Generator, impulse_ns: float, shortest_s: float, longest_s: float
    ) -> None:
        """Begin at zero; between two pushes there are from `shortest_s` to `longest_s`."""
        self._random = random
        self._impulse_ns = impulse_ns
        self._range_s = (shortest_s, longest_s)
        self._next_s = random.uniform(*self._range_s)

    def due(self, time_s: float) -> Push | None:
        """Return the push that begins now, if one does."""
        if time_s < self._next_s:
            return None
        self._next_s += self._random.uniform(*self._range_s)
        return push(self._impulse_ns, self._random.uniform(-math.pi, math.pi))


class DropOuts:
    """Ticks that a controller misses, because its computer is busy elsewhere."""

    def __init__(self, random: np.random.Generator, chance: float, longest_ticks: int) -> None:
        """Set the chance that a drop-out begins at a tick; it lasts 1 to `longest_ticks`."""
        self._random = random
        self._chance = chance
        self._longest_ticks = longest_ticks
        self._left = 0

    def misses(self) -> bool:
        """Tell whether the controller misses this tick."""
        if self._left == 0 and self._random.random() < self._chance:
            self._left = int(self._random.integers(1, self._longest_ticks + 1))
        missed = self._left > 0
        self._left -= missed
        return missed


class Latency:
    """Targets that come late."""

    def __init__(self, ticks: int) -> None:
        """Set how late."""
        self._waiting: deque[JointTargets] = deque()
        self._ticks = ticks

    def through(self, targets: JointTargets) -> JointTargets | None:
        """Send targets, and return those that arrive, if there are some already."""
        self._waiting.append(targets)
        return self._waiting.popleft() if len(self._waiting) > self._ticks else None
