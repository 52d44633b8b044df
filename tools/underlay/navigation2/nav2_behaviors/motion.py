# SPDX-License-Identifier: Apache-2.0
"""Speed profiles of behaviours, and the progress of a rotation."""

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
    Progress of a rotation, which may exceed a full turn.

    Parameters
    ----------
    target_rad
        The angle to turn by, positive counter-clockwise.
    yaw_rad
        The yaw at the start.

    """

    def __init__(self, target_rad: float, yaw_rad: float) -> None:
        self.target_rad, self._yaw_rad = target_rad, yaw_rad
        self.turned_rad = 0.0

    def update(self, yaw_rad: float) -> None:
        """
        Add the rotation since the last update.

        Parameters
        ----------
        yaw_rad
            The current yaw, less than half a turn from the previous one.

        """
        self.turned_rad += angle_between(self._yaw_rad, yaw_rad)
        self._yaw_rad = yaw_rad

    @property
    def remaining_rad(self) -> float:
        """Return the remaining angle, positive before the target and negative beyond it."""
        return abs(self.target_rad) - math.copysign(1.0, self.target_rad) * self.turned_rad

    @property
    def is_done(self) -> bool:
        """Whether the target is reached."""
        return self.remaining_rad < _ARRIVED_RAD


def turn_rate(
    remaining_rad: float, max_rate: float, min_rate: float, acceleration: float
) -> float:
    """
    Compute the angular speed at which the robot can still stop at the target.

    Parameters
    ----------
    remaining_rad
        The remaining angle.
    max_rate, min_rate
        The limits in rad/s.
    acceleration
        The deceleration in rad/s^2.

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
    Compute the speed (unsigned) at which the robot can still stop at the target.

    Parameters
    ----------
    speed
        The commanded speed in m/s.
    last_speed
        The speed returned one period ago.
    remaining_m
        The remaining distance.
    acceleration, deceleration
        The acceleration limits, both positive, in m/s^2; 0 for no limit.
    minimum_speed
        The minimum speed at which the robot moves at all, unless a lower one is commanded.
    period_s
        The control period.

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
    Predict the poses of the robot at constant velocity.

    Parameters
    ----------
    velocity
        Constant, in the base frame.
    horizon_s, step_s
        The prediction horizon and the time step.
    until_s
        The end of the motion, if earlier.

    Returns
    -------
    tuple of numpy.ndarray
        (K,) times in s, the first one step from now, and (K, 3) poses x, y (m), yaw (rad) in the
        current base frame.

    """
    end_s = min(horizon_s, max(until_s, 0.0))
    step_s = max(step_s, end_s * 1e-3, 1e-6)
    count = max(math.ceil(end_s / step_s - 1e-9), 1)
    times = np.minimum(np.arange(1, count + 1) * step_s, max(end_s, 1e-6))
    return times, velocity.poses_after(times)
