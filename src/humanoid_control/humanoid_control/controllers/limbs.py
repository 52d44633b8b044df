# SPDX-License-Identifier: Apache-2.0
"""The controllers of arms, head, waist and grippers."""

from __future__ import annotations

from collections.abc import Sequence

from humanoid_control.controllers.gripper_controller import GripperController
from humanoid_control.controllers.joint_trajectory_controller import JointTrajectoryController
from humanoid_control.limits import JointLimits

LIMBS = {
    'left_arm_controller': ('left_shoulder', 'left_elbow', 'left_wrist'),
    'right_arm_controller': ('right_shoulder', 'right_elbow', 'right_wrist'),
    'head_controller': ('head_',),
    'waist_controller': ('waist_',),
}
"""Substrings of the joint names of each controller, after a prefix."""


GRIPPERS = {'left_gripper_controller': 'left_gripper', 'right_gripper_controller': 'right_gripper'}
"""Suffix of the joint name of each gripper controller."""


def gripper_controllers(
    joints: Sequence[str], limits: JointLimits
) -> tuple[GripperController, ...]:
    """
    Create the controllers of the grippers of a robot.

    Parameters
    ----------
    joints, limits
        All joints of the robot, in the order of its targets, and their limits.

    """
    return tuple(
        GripperController(name, joints, joint, limits)
        for name, end in GRIPPERS.items()
        for joint in joints
        if joint.endswith(end)
    )


def limb_controllers(joints: Sequence[str]) -> tuple[JointTrajectoryController, ...]:
    """
    Create the trajectory controllers of the limbs of a robot.

    Parameters
    ----------
    joints
        All joints of the robot, in the order of its targets.

    """
    limbs = {
        name: [joint for joint in joints if any(part in joint for part in parts)]
        for name, parts in LIMBS.items()
    }
    return tuple(
        JointTrajectoryController(name, joints, own) for name, own in limbs.items() if own
    )
