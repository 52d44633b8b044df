# SPDX-License-Identifier: Apache-2.0
"""A copy of the state of a world, for those who look at it."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_control.backends import Array


@dataclass(frozen=True, eq=False)
class Snapshot:
    """Positions and velocities as MuJoCo counts them, at a moment."""

    time_s: float
    qpos: Array
    qvel: Array
