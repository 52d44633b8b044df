# SPDX-License-Identifier: Apache-2.0
"""Status of the walk."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from humanoid_control.walking.footsteps import Footstep
from humanoid_control.walking.odometry import Odometry
from humanoid_control.walking.planar import PlanarPose, Point


@dataclass(frozen=True, eq=False)
class WalkStatus:
    """Status of the walk at a time; points are in the ground plane of the odom frame."""

    phase: str
    """'stand', 'walk', 'stop', 'fallen' or 'stand_up'."""
    support: tuple[int, ...]
    """Sides of the feet that carry the robot: 0 left, 1 right; empty while it is down."""
    feet: tuple[PlanarPose, PlanarPose]
    """Present or last footholds, left and right."""
    footsteps: Sequence[Footstep]
    """Planned landings, the next one first."""
    odometry: Odometry
    dcm_m: Point
    dcm_reference_m: Point
    zmp_m: Point
    """Commanded zero-moment point."""
    zmp_reference_m: Point
