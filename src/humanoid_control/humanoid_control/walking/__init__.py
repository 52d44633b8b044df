# SPDX-License-Identifier: Apache-2.0
"""Bipedal walking control, in pure numpy."""

from humanoid_control.walking.commands import VelocityCommand, VelocityLimits
from humanoid_control.walking.errors import WalkingError
from humanoid_control.walking.footsteps import Footstep
from humanoid_control.walking.odometry import Odometry
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.planar import PlanarPose, Point
from humanoid_control.walking.walk import WalkStatus
from humanoid_control.walking.walker import Walker

__all__ = [
    'Footstep',
    'Odometry',
    'PlanarPose',
    'Point',
    'VelocityCommand',
    'VelocityLimits',
    'WalkParameters',
    'WalkStatus',
    'Walker',
    'WalkingError',
]
