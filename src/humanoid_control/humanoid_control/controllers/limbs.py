# SPDX-License-Identifier: Apache-2.0
"""The controllers of arms and head."""

from __future__ import annotations

from collections.abc import Sequence

from humanoid_control.controllers.joint_trajectory_controller import JointTrajectoryController

LIMBS = {
    'left_arm_controller': ('left_shoulder', 'left_elbow', 'left_wrist'),
    'right_arm_controller': ('right_shoulder', 'right_elbow', 'right_wrist'),
    'head_controller': ('head_',),
}
"""What the names of the joints of a controller contain, after a prefix."""


def limb_controllers(joints: Sequence[str]) -> tuple[JointTrajectoryController, ...]:
    """
    Make the controllers of the limbs that a robot has.

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
