# SPDX-License-Identifier: Apache-2.0
"""Turn messages into commands."""

from __future__ import annotations

from typing import Any

from geometry_msgs.msg import Pose, Twist
from humanoid_control.controllers import CommandError, TrajectoryPoint
from humanoid_control.dynamics.rotations import from_quaternion, to_rpy
from humanoid_control.walking.body_pose import BodyPose
from humanoid_control.walking.errors import WalkingError
from humanoid_control.walking.velocity_command import VelocityCommand
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

MOST_POINTS = 1000
"""Of a trajectory: while it is checked, the robot is not controlled."""


def velocity_of(message: Twist) -> VelocityCommand:
    """Return the velocity in the plane, or raise WalkingError; the rest of it means nothing."""
    return VelocityCommand(message.linear.x, message.linear.y, message.angular.z)


def body_pose_of(message: Pose) -> BodyPose:
    """
    Return how the body is to be held, or raise WalkingError.

    Of the position the height counts, compared to that of a robot that stands upright, and of the
    orientation the pitch.
    """
    turn = message.orientation
    try:
        rotation = from_quaternion((turn.w, turn.x, turn.y, turn.z))
    except ValueError as error:
        raise WalkingError(str(error)) from None
    return BodyPose(to_rpy(rotation)[1], message.position.z)


def seconds(time: Any) -> float:
    """Return a time or a duration of `builtin_interfaces` in seconds."""
    return float(time.sec + time.nanosec * 1e-9)


def points_of(message: JointTrajectory) -> list[TrajectoryPoint]:
    """Return the points of a trajectory, or raise CommandError if they are too many."""
    count = len(message.points)
    if count > MOST_POINTS:
        raise CommandError(
            f'It has {count} points. Give at most {MOST_POINTS}, one after the other if need be: '
            'what is between points is smooth.'
        )
    return [_point_of(point) for point in message.points]


def _point_of(point: JointTrajectoryPoint) -> TrajectoryPoint:
    time_s = seconds(point.time_from_start)
    return TrajectoryPoint(time_s, point.positions, point.velocities, point.accelerations)
