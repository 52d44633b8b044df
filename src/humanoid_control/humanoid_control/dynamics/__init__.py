# SPDX-License-Identifier: Apache-2.0
"""Kinematics and dynamics of the humanoid, in numpy alone."""

from humanoid_control.dynamics.body_model import BodyModel
from humanoid_control.dynamics.body_state import BodyState
from humanoid_control.dynamics.errors import DynamicsError
from humanoid_control.dynamics.joint_group import JointGroup

__all__ = ['BodyModel', 'BodyState', 'DynamicsError', 'JointGroup']
