# SPDX-License-Identifier: Apache-2.0
"""How fast a behaviour moves on the way to its end, and how far it has come."""

from __future__ import annotations

import math

from nav2_util.geometry import angle_between
from nav2_util.twist import Velocity
import numpy as np
import numpy.typing as npt

__all__ = ['Turn', 'drive_speed', 'motion_ahead', 'turn_rate']

FloatArray = npt.NDArray[np.float64]
_ARRIVED_RAD = 1e-6


class Turn:
    """
    How far a robot has turned, also by more than a whole turn.

    Parameters
    ----------
    target_rad
        How far it is to turn, positive to the left.
    yaw_rad
        Its yaw at the start.

    """

    def __init__(self, target_rad: float, yaw_rad: float) -> None:
        self.target_rad, self._yaw_rad = target_rad, yaw_rad
        self.turned_rad = 0.0

    def update(self, yaw_rad: float) -> None:
        """
        Add the turn since the last update.

        Parameters
        ----------
        yaw_rad
            The yaw of now, less than half a turn from the one before.

        """
        self.turned_rad += angle_between(self._yaw_rad, yaw_rad)
        self._yaw_rad = yaw_rad

    @property
    def remaining_rad(self) -> float:
        """Return what is left, without the sign of the target; negative beyond it."""
        return abs(self.target_rad) - math.copysign(1.0, self.target_rad) * self.turned_rad

    @property
    def is_done(self) -> bool:
        """Whether the target is reached."""
        return self.remaining_rad < _ARRIVED_RAD


def turn_rate(
    remaining_rad: float, max_rate: float, min_rate: float, acceleration: float
) -> float:
    """
    Return how fast to turn so that the robot can still stop at the target.

    Parameters
    ----------
    remaining_rad
        What is left to turn.
    max_rate, min_rate
        The limits in rad/s.
    acceleration
        How fast the robot can stop, in rad/s^2.

    """
    rate = math.sqrt(2.0 * acceleration * max(remaining_rad, 0.0))
    return min(max(rate, min_rate), max_rate)


def drive_speed(
    speed: float,
    last_speed: float,
    remaining_m: float,
    *,
    acceleration: float,
    deceleration: float,
    minimum_speed: float,
    period_s: float,
) -> float:
    """
    Return how fast to drive, without a sign, so that the robot can still stop at the target.

    Parameters
    ----------
    speed
        The commanded speed in m/s.
    last_speed
        What was returned one period ago.
    remaining_m
        What is left to drive.
    acceleration, deceleration
        How fast the speed grows and shrinks, both positive, in m/s^2; 0 for at once.
    minimum_speed
        The least speed at which the robot moves at all, unless it is told to drive slower.
    period_s
        The time between two speeds.

    """
    allowed = abs(speed)
    if acceleration > 0.0:
        allowed = min(allowed, last_speed + acceleration * period_s)
    if deceleration > 0.0:
        allowed = min(allowed, math.sqrt(2.0 * deceleration * max(remaining_m, 0.0)))
    return max(allowed, min(minimum_speed, abs(speed)))


def motion_ahead(
    velocity: Velocity, horizon_s: float, step_s: float, until_s: float = math.inf
) -> tuple[FloatArray, FloatArray]:
    """
    Return where the robot will be if it goes on like that.

    Parameters
    ----------
    velocity
        Constant, in the base frame.
    horizon_s, step_s
        How far to look ahead, and in which steps.
    until_s
        When the motion ends, if that is sooner.

    Returns
    -------
    tuple of numpy.ndarray
        (K,) times in s, the first one step from now, and (K, 3) poses x, y (m), yaw (rad) in the
        base frame of now.

    """
    end_s = min(horizon_s, max(until_s, 0.0))
    step_s = max(step_s, end_s * 1e-3, 1e-6)
    count = max(math.ceil(end_s / step_s - 1e-9), 1)
    times = np.minimum(np.arange(1, count + 1) * step_s, max(end_s, 1e-6))
    return times, velocity.poses_after(times)
