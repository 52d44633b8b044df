# SPDX-License-Identifier: Apache-2.0
"""Where the base is since the walk began, and how sure that is."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_control.backends import ImuNoise
from humanoid_control.walking.planar import PlanarPose, Point
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
# What the legs are off by, besides what the inertial sensor says, as measured in
# simulation by the benchmark odometry_errors.py.
_SLIP_M2_M = 2e-5
"""How the variance of x and of y grows with the way."""
_RISE_M2_M = 1e-5
"""How the variance of the height does: each foothold is a little off."""
_SCALE = 1e-3
"""By how much every step is too long or too short: a deviation that stays."""
_SMALLEST = 1e-6
_STEP_M, _STEP_S = 0.02, 0.5
"""Errors grow in steps of this size: between two of them they change too little to matter."""


@dataclass(frozen=True, eq=False)
class Odometry:
    """
    Where the base is, by the legs and the inertial sensor.

    The frame has its origin on the ground where the base was first, and x where it faced.
    """

    pose: PlanarPose
    height_m: float
    orientation: tuple[float, float, float, float]
    """Of the base, w, x, y, z."""
    linear_velocity_m_s: Array
    """(3,) in the axes of the base."""
    angular_velocity_rad_s: Array
    """(3,) in the axes of the base."""
    covariance: Array
    """(6, 6) of x, y, z in m and of the turns about x, y, z in rad, in the odometry's frame."""


class Uncertainty:
    """
    Covariance of leg odometry whose heading drifts.

    Dead reckoning: position errors are those of the legs, and those of the way that is taken in
    the wrong direction while the heading is off. The heading is that of a sensor without a
    compass, off by a constant rate and by a random walk. First-order propagation of the state x,
    y, heading, rate of drift and scale of the steps: see Thrun, Burgard and Fox, "Probabilistic
    Robotics" (2005), chapters 3 and 5. A sensor that takes level ground for a slope makes the
    robot climb as long as it walks ahead, and sink on the way back: the error of the height goes
    with the way in the axes of the robot, in which the bias of the sensor stays.

    Parameters
    ----------
    imu
        How far the inertial sensor is off.
    height_m
        Height of the base above the feet, over which an error of the tilt moves the base.

    """

    def __init__(self, imu: ImuNoise = ImuNoise(), height_m: float = 0.0) -> None:
        self._imu, self._height_m = imu, height_m
        self._last: PlanarPose | None = None
        self._last_s = 0.0
        self._height_m2 = _SMALLEST
        self._way_m: Point = 0j
        drift, scale = imu.heading_drift_rad_s**2, _SCALE**2
        self._p: Array = np.diag([_SMALLEST, _SMALLEST, _SMALLEST, drift, scale])

    def update(self, pose: PlanarPose, time_s: float) -> None:
        """
        Propagate the covariance to a new pose of the base.

        Small changes are accumulated until they are worth a step of the propagation.

        Parameters
        ----------
        pose
            Of the base, in the plane of the odom frame (m, rad).
        time_s
            When it was there, by a clock that never goes back.

        """
        if self._last is None:
            self._last, self._last_s = pose, time_s
        way = pose.position_m - self._last.position_m
        passed_s = time_s - self._last_s
        if abs(way) >= _STEP_M or passed_s >= _STEP_S:
            self._grow(way, passed_s)
            self._way_m += self._last.halfway(pose).seen(way)
            self._last, self._last_s = pose, time_s

    def _grow(self, way: Point, passed_s: float) -> None:
        """Propagate the covariance over a piece of the way (m) that took some time."""
        step = np.eye(5)
        step[0, 2], step[1, 2] = -way.imag, way.real
        step[0, 4], step[1, 4] = way.real, way.imag
        step[2, 3] = passed_s
        self._p = step @ self._p @ step.T
        self._height_m2 += _RISE_M2_M * abs(way)
        slip_m2 = _SLIP_M2_M * abs(way)
        walk_rad2 = self._imu.heading_walk_rad_sqrt_s**2 * passed_s
        self._p[(0, 1, 2), (0, 1, 2)] += (slip_m2, slip_m2, walk_rad2)

    @property
    def covariance(self) -> Array:
        """Return how sure the pose is, a matrix (6, 6) as in `Odometry`."""
        planar, result = (0, 1, 5), np.zeros((6, 6))
        result[np.ix_(planar, planar)] = self._p[:3, :3]
        tilt_rad2 = max(self._imu.tilt_rad**2, _SMALLEST)
        # A base that leans is not where the legs below it say.
        result[(0, 1), (0, 1)] += tilt_rad2 * self._height_m**2
        slope_m2 = (self._imu.tilt_bias_rad * abs(self._way_m)) ** 2
        result[(2, 3, 4), (2, 3, 4)] = (self._height_m2 + slope_m2, tilt_rad2, tilt_rad2)
        return result
