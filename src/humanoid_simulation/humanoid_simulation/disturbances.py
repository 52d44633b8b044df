# SPDX-License-Identifier: Apache-2.0
"""Disturbances of a controller besides pushes, noise and latency: missed ticks."""

from __future__ import annotations

import numpy as np


class DropOuts:
    """
    Random drop-outs of control: ticks that are missed because the computer is overloaded.

    Parameters
    ----------
    random
        Source of random numbers.
    chance
        Probability that a drop-out starts at a tick, unless one is in progress.
    longest_ticks
        Maximum length of a drop-out; lengths from 1 tick are uniformly distributed.

    """

    def __init__(self, random: np.random.Generator, chance: float, longest_ticks: int) -> None:
        self._random = random
        self._chance = chance
        self._longest_ticks = longest_ticks
        self._left = 0

    def misses(self) -> bool:
        """Decide whether the controller misses this tick; call once per tick."""
        if self._left == 0 and self._random.random() < self._chance:
            self._left = int(self._random.integers(1, self._longest_ticks + 1))
        missed = self._left > 0
        self._left -= missed
        return missed
