# SPDX-License-Identifier: Apache-2.0
"""A world of robots and things, as MuJoCo wants it."""

from humanoid_simulation.model.description import humanoid, RobotDescription
from humanoid_simulation.model.physics import Physics
from humanoid_simulation.model.placement import Placement
from humanoid_simulation.model.world import build_world, in_world

__all__ = ['Physics', 'Placement', 'RobotDescription', 'build_world', 'humanoid', 'in_world']
