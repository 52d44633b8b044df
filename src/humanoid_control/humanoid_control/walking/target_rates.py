# SPDX-License-Identifier: Apache-2.0
"""Velocities and accelerations of the joints' targets."""

from __future__ import annotations

import math

from humanoid_control.walking.parameters import WalkParameters
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class TargetRates:
    """Differences of targets from tick to tick, smoothed and limited."""

    def __init__(self, parameters: WalkParameters, joints: int) -> None:
        """Begin at rest."""
        self._parameters = parameters
        self._positions: Array | None = None
        self.velocities_rad_s: Array = np.zeros(joints)
        self.accelerations_rad_s2: Array = np.zeros(joints)

    def update(self, positions_rad: Array, passed_s: float) -> None:
        """Take the targets (n,) of a tick, and the time since the tick before."""
        if self._positions is not None and passed_s > 0.0:
            p, before = self._parameters, self.velocities_rad_s
            self.velocities_rad_s = _follow(
                before,
                (positions_rad - self._positions) / passed_s,
                p.velocity_limit_rad_s,
                1.0 - math.exp(-p.velocity_filter_1_s * passed_s),
            )
            self.accelerations_rad_s2 = _follow(
                self.accelerations_rad_s2,
                (self.velocities_rad_s - before) / passed_s,
                p.acceleration_limit_rad_s2,
                1.0 - math.exp(-p.acceleration_filter_1_s * passed_s),
            )
        self._positions = positions_rad


def _follow(value: Array, goal: Array, limit: float, share: float) -> Array:
    """Return the value a share of the way nearer to a goal within limits."""
    followed: Array = value + share * (np.minimum(np.maximum(goal, -limit), limit) - value)
    return followed
