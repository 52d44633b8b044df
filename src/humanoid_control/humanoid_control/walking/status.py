# SPDX-License-Identifier: Apache-2.0
"""What the walk tells others."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from humanoid_control.walking.footsteps import Footstep
from humanoid_control.walking.odometry import Odometry
from humanoid_control.walking.planar import PlanarPose, Point


@dataclass(frozen=True, eq=False)
class WalkStatus:
    """The walk at a moment; points are on the ground in the frame of the odometry."""

    phase: str
    """'stand', 'walk', 'stop', 'fallen' or 'stand_up'."""
    support: tuple[int, ...]
    """The sides whose feet carry the robot: 0 left, 1 right; none while it is down."""
    feet: tuple[PlanarPose, PlanarPose]
    """Where the soles stand, or stood last."""
    footsteps: Sequence[Footstep]
    """The landings that are planned, the next one first."""
    odometry: Odometry
    dcm_m: Point
    dcm_reference_m: Point
    zmp_m: Point
    """The zero-moment point that is commanded."""
    zmp_reference_m: Point
