# SPDX-License-Identifier: Apache-2.0
"""A robot with three joints, and goals for trajectories, for tests of backends and controllers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from builtin_interfaces.msg import Duration
from control_msgs.action import FollowJointTrajectory
from humanoid_control.backends import JointLimits, JointTargets, Observation
from humanoid_description.drives import Drive
import numpy as np
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

JOINTS = ('left_elbow', 'right_elbow', 'left_knee')
DRIVES = {
    name: Drive(
        lower=-2.0,
        upper=1.0,
        effort=20.0,
        velocity=10.0,
        damping=0.2,
        friction=0.1,
        kp=60.0,
        kd=1.8,
        armature=0.01,
    )
    for name in JOINTS
}
LIMITS = JointLimits.of(DRIVES, JOINTS)
PERIOD_S = 0.01


def observed(time_s: float, *positions_rad: float) -> Observation:
    """
    Build an observation of the three-joint robot, upright and at rest.

    Parameters
    ----------
    time_s
        Time of the observation.
    *positions_rad
        Positions in the order of `JOINTS`; all zero if none are given.

    """
    return Observation(
        time_s=time_s,
        positions_rad=np.array(positions_rad or (0.0, 0.0, 0.0)),
        velocities_rad_s=np.zeros(3),
        efforts_nm=np.zeros(3),
        orientation=np.array([1.0, 0.0, 0.0, 0.0]),
        angular_velocity_rad_s=np.zeros(3),
        linear_acceleration_m_s2=np.array([0.0, 0.0, 9.81]),
        foot_forces_n=np.zeros((2, 3)),
        foot_torques_nm=np.zeros((2, 3)),
    )


def targets(*positions_rad: float, velocity_rad_s: float = 0.0) -> JointTargets:
    """
    Build joint targets without efforts.

    Parameters
    ----------
    *positions_rad
        Target positions, one per joint.
    velocity_rad_s
        Target velocity of each joint.

    """
    count = len(positions_rad)
    return JointTargets(np.array(positions_rad), np.full(count, velocity_rad_s), np.zeros(count))


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
