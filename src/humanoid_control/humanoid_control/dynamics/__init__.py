# SPDX-License-Identifier: Apache-2.0
"""Kinematics and dynamics of the humanoid, in pure numpy."""

from humanoid_control.dynamics.body_model import BodyModel
from humanoid_control.dynamics.body_state import BodyState
from humanoid_control.dynamics.frames import Frame, Twist
from humanoid_control.dynamics.leg_ik import leg_posture, leg_rates, LegGeometry, LegPosture
from humanoid_control.dynamics.tree import DynamicsError, JointGroup

__all__ = [
    'BodyModel',
    'BodyState',
    'DynamicsError',
    'Frame',
    'JointGroup',
    'LegGeometry',
    'LegPosture',
    'Twist',
    'leg_posture',
    'leg_rates',
]
