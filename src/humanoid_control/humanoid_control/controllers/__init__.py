# SPDX-License-Identifier: Apache-2.0
"""Controllers, which compute the joint targets for the backend in each control period."""

from humanoid_control.controllers.command_controllers import Follower, TrajectoryRunner
from humanoid_control.controllers.commands import CommandError, JointNames, PartialTargets
from humanoid_control.controllers.gripper_controller import (
    Grip,
    GripperController,
    GripResult,
    GripState,
)
from humanoid_control.controllers.interface import ClaimingController, Controller, GoalController
from humanoid_control.controllers.joint_trajectory_controller import (
    ErrorCode,
    GoalResult,
    JointTrajectoryController,
)
from humanoid_control.controllers.manager import ControllerManager
from humanoid_control.controllers.modes import follow_mode, Hold, hold_mode, Mode
from humanoid_control.controllers.trajectory import checked_trajectory, TrajectoryPoint
from humanoid_control.controllers.trajectory_goal import (
    checked_goal,
    JointTolerance,
    TrajectoryGoal,
    TrajectoryRequest,
)

__all__ = [
    'ClaimingController',
    'CommandError',
    'Controller',
    'ControllerManager',
    'ErrorCode',
    'Follower',
    'GoalController',
    'GoalResult',
    'Grip',
    'GripResult',
    'GripState',
    'GripperController',
    'Hold',
    'JointNames',
    'JointTolerance',
    'JointTrajectoryController',
    'Mode',
    'PartialTargets',
    'TrajectoryGoal',
    'TrajectoryPoint',
    'TrajectoryRequest',
    'TrajectoryRunner',
    'checked_goal',
    'checked_trajectory',
    'follow_mode',
    'hold_mode',
]
