# SPDX-License-Identifier: Apache-2.0
"""MuJoCo models of worlds with robots and objects."""

from humanoid_simulation.model.description import (
    humanoid,
    in_world,
    Physics,
    Placement,
    RobotDescription,
)
from humanoid_simulation.model.world import build_world

__all__ = ['Physics', 'Placement', 'RobotDescription', 'build_world', 'humanoid', 'in_world']
