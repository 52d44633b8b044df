# SPDX-License-Identifier: Apache-2.0
"""What makes it hard for a controller, besides pushes, noise and latency: missed ticks."""

from __future__ import annotations

import numpy as np


class DropOuts:
    """
    Random drop-outs of control: ticks that it misses because its computer is busy elsewhere.

    Parameters
    ----------
    random
        Source of random numbers.
    chance
        Probability that a drop-out begins at a tick, unless one lasts already.
    longest_ticks
        A drop-out lasts 1 to so many ticks, each number as likely.

    """

    def __init__(self, random: np.random.Generator, chance: float, longest_ticks: int) -> None:
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
