# SPDX-License-Identifier: Apache-2.0
"""What makes it hard for a controller, besides pushes, noise and latency: missed ticks."""

from __future__ import annotations

import numpy as np


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
