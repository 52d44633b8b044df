# SPDX-License-Identifier: Apache-2.0
"""Convert messages to commands."""

from __future__ import annotations

from typing import Any

from geometry_msgs.msg import Pose, Twist
from humanoid_control.controllers import CommandError, TrajectoryPoint
from humanoid_control.controllers.trajectory import MOST_POINTS
from humanoid_control.walking.commands import BodyPose, VelocityCommand
from humanoid_control.walking.errors import WalkingError
from humanoid_description.rotations import from_quaternion, to_rpy
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint


def velocity_of(message: Twist) -> VelocityCommand:
    """
    Convert a Twist to a planar velocity command; its other components are ignored.

    Parameters
    ----------
    message
        Velocity in the axes of the body: `linear.x`, `linear.y` (m/s) and `angular.z` (rad/s).

    Raises
    ------
    WalkingError
        One of the three is not finite.

    """
    return VelocityCommand(message.linear.x, message.linear.y, message.angular.z)


def body_pose_of(message: Pose) -> BodyPose:
    """
    Convert a Pose to the height and pitch of the body of a standing robot.

    Parameters
    ----------
    message
        `position.z` is the height (m) relative to that of an upright robot, negative is lower.
        Only the pitch of the orientation is used; positive bends forward. All else is ignored.

    Raises
    ------
    WalkingError
        The orientation is not a rotation: its norm is zero or not finite.

    """
    turn = message.orientation
    try:
        rotation = from_quaternion((turn.w, turn.x, turn.y, turn.z))
    except ValueError as error:
        raise WalkingError(str(error)) from None
    return BodyPose(to_rpy(rotation)[1], message.position.z)


def seconds(time: Any) -> float:
    """
    Convert a ROS time or duration to seconds.

    Parameters
    ----------
    time
        A `Time` or `Duration` of `builtin_interfaces`.

    """
    return float(time.sec + time.nanosec * 1e-9)


def points_of(message: JointTrajectory) -> list[TrajectoryPoint]:
    """
    Convert the points of a JointTrajectory, without checking their values.

    Parameters
    ----------
    message
        The trajectory; positions are in rad, or m for prismatic joints.

    Raises
    ------
    CommandError
        It has more than `MOST_POINTS` points.

    """
    count = len(message.points)
    if count > MOST_POINTS:
        raise CommandError(
            f'It has {count} points. Give at most {MOST_POINTS}, or split it into several goals: '
            'the motion between points is smooth.'
        )
    return [_point_of(point) for point in message.points]


def _point_of(point: JointTrajectoryPoint) -> TrajectoryPoint:
    time_s = seconds(point.time_from_start)
    return TrajectoryPoint(time_s, point.positions, point.velocities, point.accelerations)
