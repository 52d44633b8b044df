# SPDX-License-Identifier: Apache-2.0
"""Walk along waypoints, for tests that drive the robot through the apartment."""

from __future__ import annotations

import cmath
from collections.abc import Sequence
import math

from humanoid_control.walking.planar import PlanarPose
from humanoid_simulation.testing.lockstep_robot import LockstepRobot

__all__ = ['FROM_HALL', 'NEAR_M', 'ROUTES', 'distance_m', 'steer', 'walk']

NEAR_M = 0.15
ROUTES = {
    'hall': [(-2.0, 0.0)],
    'kitchen': [(1.3, 0.0), (1.3, 1.7)],
    'bedroom': [(2.4, 0.0), (4.35, 0.0), (4.4, 1.6)],
    'living_room': [(2.7, 0.0), (2.7, -1.5)],
}
FROM_HALL = [(-1.6, -0.3), (-1.6, -1.5), (0.2, -1.6)]


def steer(pose: PlanarPose, goal_m: tuple[float, float]) -> tuple[float, float]:
    """
    Compute the velocity command towards a point: turn first, then walk.

    Parameters
    ----------
    pose
        The pose of the robot.
    goal_m
        The point, in m, in the frame of the pose.

    Returns
    -------
    float, float
        Forward velocity in m/s, and yaw rate in rad/s, positive to the left.

    """
    way = complex(*goal_m) - pose.position_m
    off_rad = math.remainder(cmath.phase(way) - pose.yaw_rad, math.tau)
    turn_rad_s = max(-0.6, min(0.6, 1.5 * off_rad))
    return (0.0, turn_rad_s) if abs(off_rad) > 0.35 else (0.3, turn_rad_s)


def distance_m(pose: PlanarPose, goal_m: tuple[float, float]) -> float:
    """
    Compute the distance from a pose to a point, in m.

    Parameters
    ----------
    pose
        The pose of the robot.
    goal_m
        The point (x, y), in the frame of the pose.

    """
    return abs(complex(*goal_m) - pose.position_m)


def walk(robot: LockstepRobot, route: Sequence[tuple[float, float]]) -> None:
    """
    Walk along waypoints.

    Parameters
    ----------
    robot
        A robot in lockstep with its simulator.
    route
        The waypoints (x, y) in order, in m in the world frame.

    Raises
    ------
    AssertionError
        The robot falls, is blocked, or does not reach a waypoint within a minute.

    """
    for goal_m in route:
        for _ in range(600):
            if distance_m(robot.pose, goal_m) < NEAR_M:
                break
            forward, turn = steer(robot.pose, goal_m)
            robot.drive(forward, turn=turn)
            assert robot.wait(0.1), f'it fell at {robot.pose} on its way to {goal_m}'
            assert not robot.walking.walker.is_blocked, f'something is in its way at {robot.pose}'
        assert distance_m(robot.pose, goal_m) < NEAR_M, f'it is at {robot.pose}, not {goal_m}'
