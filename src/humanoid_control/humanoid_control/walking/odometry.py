# SPDX-License-Identifier: Apache-2.0
"""Leg odometry: motion of the base over feet that stand still, and the covariance of its pose."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from humanoid_control.backends import ImuNoise
from humanoid_control.dynamics.body_state import BodyState
from humanoid_control.dynamics.frames import Frame, Twist
from humanoid_control.walking.footing import Footing
from humanoid_control.walking.pendulum import Motion
from humanoid_control.walking.planar import limited, PlanarPose, Point, SIDES
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
_SURE_LOAD = 0.2
"""A foot that carries this fraction of the weight certainly stands on the ground."""
_LEAST_TRUST = 0.02
"""Below this total the robot is airborne or falling: the commanded shares are used instead."""
# Errors of the legs, besides those of the IMU, as measured in simulation by the benchmark
# odometry_errors.py.
_SLIP_M2_M = 2e-5
"""Growth of the variance of x and of y with the distance travelled."""
_RISE_M2_M = 1e-5
"""Growth of the variance of the height with it: each foothold is slightly off."""
_SCALE = 1e-3
"""Standard deviation of the scale of all steps: a constant error."""
_SMALLEST = 1e-6
_STEP_M, _STEP_S = 0.02, 0.5
"""Distance and time between propagations of the covariance: it changes too little in between."""


@dataclass(frozen=True, eq=False)
class BaseMotion:
    """Pose and twist of the base in the odom frame, measured or wanted."""

    frame: Frame
    twist: Twist


@dataclass(frozen=True, eq=False)
class BaseEstimate:
    """Estimated position and velocity of the origin of the base, in the odom frame."""

    position_m: Array
    """(3,)"""
    velocity_m_s: Array
    """(3,)"""

    def motion(self, state: BodyState) -> BaseMotion:
        """
        Combine the estimated position and velocity with the measured rotation of the base.

        Parameters
        ----------
        state
            State of the robot, which holds the rotation and the angular velocity of the base.

        Returns
        -------
        BaseMotion
            Pose and twist of base_link, both in the odom frame.

        """
        return BaseMotion(
            Frame(self.position_m, state.base_rotation),
            Twist(self.velocity_m_s, state.base_angular_velocity_rad_s),
        )

    def com_motion(self, state: BodyState) -> Motion:
        """
        Compute the horizontal motion of the centre of mass.

        Parameters
        ----------
        state
            State of the robot, with the centre of mass relative to the origin of base_link.

        Returns
        -------
        Motion
            Position in m and velocity in m/s, in the plane of the odom frame.

        """
        position = self.position_m + state.com_m
        velocity = self.velocity_m_s + state.com_velocity_m_s
        return Motion(complex(position[0], position[1]), complex(velocity[0], velocity[1]))


def carrying(shares: tuple[float, float], loads: tuple[float, float]) -> tuple[float, float]:
    """
    Compute how much each foot contributes to leg odometry, from the load that it carries.

    A foot that should carry weight but does not may be off its foothold: below a fifth of the
    weight of the robot its contribution fades out.

    Parameters
    ----------
    shares
        Commanded load distribution, left and right; the sum is 1.
    loads
        Measured normal forces on the soles, as fractions of the weight of the robot.

    Returns
    -------
    tuple of float
        Weights of the left and the right foot, which sum to 1; `shares` if neither carries load.

    """
    left, right = (
        share * limited(load / _SURE_LOAD, 0.0, 1.0) for share, load in zip(shares, loads)
    )
    total = left + right
    return (left / total, right / total) if total > _LEAST_TRUST else shares


def base_on(
    footing: Footing, shares: tuple[float, float], soles: Sequence[str], state: BodyState
) -> BaseEstimate:
    """
    Estimate the position and velocity of the base by leg odometry.

    The feet that carry weight are assumed to stand still on their footholds.

    Parameters
    ----------
    footing
        Footholds of both feet, in the odom frame.
    shares
        Weights of the left and the right foot, which sum to 1; see `carrying`.
    soles
        Links of the left and the right sole.
    state
        Measured state of the robot, whose points are relative to the origin of base_link.

    Returns
    -------
    BaseEstimate
        Position and velocity of the origin of base_link in the odom frame.

    """
    position, velocity = np.zeros(3), np.zeros(3)
    for side in SIDES:
        if shares[side] > 0.0:
            sole = soles[side]
            position += shares[side] * (footing[side].sole_m - state.position_m(sole))
            velocity -= shares[side] * state.velocity_m_s(sole)
    return BaseEstimate(position, velocity)


@dataclass(frozen=True, eq=False)
class Odometry:
    """
    Odometry of the base from the legs and the IMU, in the odom frame.

    The odom frame has its origin on the ground below the first position of the base, and its x
    axis along the first heading.
    """

    pose: PlanarPose
    height_m: float
    orientation: tuple[float, float, float, float]
    """Quaternion w, x, y, z of the base."""
    linear_velocity_m_s: Array
    """(3,) in the axes of the base."""
    angular_velocity_rad_s: Array
    """(3,) in the axes of the base."""
    covariance: Array
    """(6, 6) of x, y, z in m and of the rotations about x, y, z in rad, in the odom frame."""


class Uncertainty:
    """
    Covariance of leg odometry whose heading drifts.

    Dead reckoning: position errors are those of the legs, and those of travelling with a wrong
    heading. The heading comes from an IMU without a compass, with a constant drift rate and a
    random walk. First-order propagation of the state x, y, heading, drift rate and scale of the
    steps: see Thrun, Burgard and Fox, "Probabilistic Robotics" (2005), chapters 3 and 5. A tilt
    bias of the IMU makes the robot seem to climb as long as it walks forward, and to descend on
    the way back: the error of the height is proportional to the displacement in the axes of the
    robot, in which the bias is constant.

    Parameters
    ----------
    imu
        Errors of the IMU.
    height_m
        Height of the base above the feet, over which a tilt error displaces the base.

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

        Small changes are accumulated until they are worth a propagation.

        Parameters
        ----------
        pose
            Pose of the base, in the plane of the odom frame (m, rad).
        time_s
            Time of the pose, on a monotonic clock.

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
        """Propagate the covariance over a displacement (m) and a duration."""
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
        """Return the covariance of the pose (6, 6), as in `Odometry`."""
        planar, result = (0, 1, 5), np.zeros((6, 6))
        result[np.ix_(planar, planar)] = self._p[:3, :3]
        tilt_rad2 = max(self._imu.tilt_rad**2, _SMALLEST)
        # A tilt error displaces the base above the feet.
        result[(0, 1), (0, 1)] += tilt_rad2 * self._height_m**2
        slope_m2 = (self._imu.tilt_bias_rad * abs(self._way_m)) ** 2
        result[(2, 3, 4), (2, 3, 4)] = (self._height_m2 + slope_m2, tilt_rad2, tilt_rad2)
        return result
