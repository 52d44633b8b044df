# SPDX-License-Identifier: Apache-2.0
"""Accelerations of the joints' targets."""

from __future__ import annotations

import math

from humanoid_control.walking.parameters import WalkParameters
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class TargetAcceleration:
    """Differences of velocities from tick to tick, smoothed and limited."""

    def __init__(self, parameters: WalkParameters) -> None:
        """Know no velocity yet."""
        self._parameters = parameters
        self._velocities: Array | None = None
        self._accelerations: Array | None = None

    def update(self, velocities_rad_s: Array, passed_s: float) -> Array:
        """Return accelerations (n,) for velocities (n,), and the time since the last ones."""
        if self._accelerations is None or self._velocities is None:
            self._accelerations = np.zeros_like(velocities_rad_s)
        elif passed_s > 0.0:
            p = self._parameters
            goal = (velocities_rad_s - self._velocities) / passed_s
            share = 1.0 - math.exp(-p.acceleration_filter_1_s * passed_s)
            self._accelerations = self._accelerations + share * (
                within(goal, p.acceleration_limit_rad_s2) - self._accelerations
            )
        self._velocities = velocities_rad_s
        return self._accelerations


def within(values: Array, limit: float) -> Array:
    """Return values that are at most as large as a limit."""
    limited: Array = np.minimum(np.maximum(values, -limit), limit)
    return limited
