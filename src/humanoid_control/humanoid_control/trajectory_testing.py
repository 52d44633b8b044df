# SPDX-License-Identifier: Apache-2.0
"""Goals of `follow_joint_trajectory`, for tests."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from builtin_interfaces.msg import Duration
from control_msgs.action import FollowJointTrajectory
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint


def trajectory_goal(
    joints: Sequence[str], *points: tuple[float, Sequence[float]], **fields: Any
) -> FollowJointTrajectory.Goal:
    """
    Build a FollowJointTrajectory goal.

    Parameters
    ----------
    joints
        The names of the joints.
    points
        Times from the start, in seconds, and joint positions.
    fields
        Other fields of the goal, such as tolerances.

    """
    way = [
        JointTrajectoryPoint(
            positions=list(map(float, positions)),
            time_from_start=Duration(sec=int(time_s), nanosec=round(time_s % 1 * 1e9)),
        )
        for time_s, positions in points
    ]
    trajectory = JointTrajectory(joint_names=list(joints), points=way)
    return FollowJointTrajectory.Goal(trajectory=trajectory, **fields)
