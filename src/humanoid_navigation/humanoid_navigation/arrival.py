# SPDX-License-Identifier: Apache-2.0
"""Navigation goal poses, and the result of a navigation goal."""

from __future__ import annotations

from dataclasses import dataclass
import math
from typing import Any

from action_msgs.msg import GoalStatus
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped, Twist

Place = tuple[float, float, float]
"""A pose in a plane: x (m), y (m), yaw (rad)."""


@dataclass(frozen=True)
class Arrival:
    """The result of a navigation goal: the status, the navigator's result, and the true errors."""

    status: int
    """A constant of `action_msgs/GoalStatus`."""
    error_code: int
    error_msg: str
    distance_m: float
    """The true distance of the robot from the goal."""
    turn_rad: float
    """The true heading error, as an absolute value."""
    took_s: float
    """The duration in simulated time."""
    recoveries: int
    touched: frozenset[str] = frozenset()
    """Bodies other than the ground that the robot touched on the way, if there is physics."""

    @property
    def is_reached(self) -> bool:
        """Whether the navigator reports that the goal was reached."""
        return bool(self.status == GoalStatus.STATUS_SUCCEEDED)


def is_zero(velocity: Twist) -> bool:
    """
    Check whether a planar velocity command is zero.

    Parameters
    ----------
    velocity
        The command, of which the linear x and y and the angular z count.

    """
    linear, angular = velocity.linear, velocity.angular
    return not any((linear.x, linear.y, angular.z))


def stamped(place: Place) -> PoseStamped:
    """
    Build a goal pose in the map frame, with a zero time stamp.

    Parameters
    ----------
    place
        x (m), y (m) and yaw (rad) in the map.

    """
    message = PoseStamped()
    message.header.frame_id = 'map'
    _fill_pose(message.pose, place)
    return message


def initial_pose(
    place: Place, position_m2: float, heading_rad2: float
) -> PoseWithCovarianceStamped:
    """
    Build the message that sets the pose of the localisation.

    Parameters
    ----------
    place
        The pose in the map.
    position_m2, heading_rad2
        The variances of x and y, and of the yaw.

    """
    message = PoseWithCovarianceStamped()
    message.header.frame_id = 'map'
    _fill_pose(message.pose.pose, place)
    message.pose.covariance[[0, 7, 35]] = position_m2, position_m2, heading_rad2
    return message


def _fill_pose(pose: Any, place: Place) -> None:
    pose.position.x, pose.position.y = map(float, place[:2])
    pose.orientation.z, pose.orientation.w = math.sin(place[2] / 2), math.cos(place[2] / 2)
