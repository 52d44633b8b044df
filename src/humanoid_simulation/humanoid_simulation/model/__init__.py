# SPDX-License-Identifier: Apache-2.0
"""MuJoCo models of worlds with robots and objects."""

from humanoid_simulation.model.description import humanoid, RobotDescription
from humanoid_simulation.model.physics import Physics
from humanoid_simulation.model.placement import Placement
from humanoid_simulation.model.world import build_world, in_world

__all__ = ['Physics', 'Placement', 'RobotDescription', 'build_world', 'humanoid', 'in_world']
