# SPDX-License-Identifier: Apache-2.0
"""State estimation: posture, attitude and forces on the feet, from joints, IMU and soles."""

from __future__ import annotations

from collections.abc import Sequence
import math

from humanoid_control.backends import Observation
from humanoid_control.dynamics.body_state import BodyState
from humanoid_control.dynamics.tree import DynamicsError
from humanoid_control.walking.errors import WalkingError
from humanoid_control.walking.pendulum import GRAVITY_M_S2
from humanoid_control.walking.planar import Point
from humanoid_control.walking.walking_robot import Attitude, RobotState, WalkingRobot
from humanoid_description.rotations import about_z, from_quaternion, to_rpy, yaw_of
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class StateEstimator:
    """
    State estimator that turns each observation into a `RobotState`.

    The first observation sets the zero of the heading.

    Parameters
    ----------
    robot
        The robot, with the model of its dynamics and the mounting of its IMU.

    """

    def __init__(self, robot: WalkingRobot) -> None:
        self._robot = robot
        self._heading = HeadingFrame(robot.imu_in_base)
        self._weight_n = robot.body.mass_kg * GRAVITY_M_S2

    def read(self, observation: Observation) -> RobotState:
        """
        Estimate the state of the robot from an observation.

        Parameters
        ----------
        observation
            Observation of the n joints that walking uses, as `WalkingRobot.own` returns it.

        Returns
        -------
        RobotState
            State in the axes of the odom frame, whose x axis is the first heading of the base.

        Raises
        ------
        WalkingError
            A measurement of the joints, the IMU or the feet has the wrong shape or is not finite.

        """
        _check('angular_velocity_rad_s', observation.angular_velocity_rad_s, (3,))
        _check('linear_acceleration_m_s2', observation.linear_acceleration_m_s2, (3,))
        _check('foot_forces_n', observation.foot_forces_n, (2, 3))
        _check('efforts_nm', observation.efforts_nm, observation.positions_rad.shape)
        try:
            rotation = self._heading.base_rotation(observation.orientation)
            rates = self._heading.base_rates(observation.angular_velocity_rad_s)
            state = self._robot.body.state(
                rotation, rates, observation.positions_rad, observation.velocities_rad_s
            )
        except (DynamicsError, ValueError) as error:
            raise WalkingError(f'The observation cannot be used: {error}') from error
        left_n, right_n = observation.foot_forces_n[:, 2].tolist()
        x, y, z = rates.tolist()
        return RobotState(
            observation.time_s,
            state,
            Attitude(*to_rpy(rotation), (x, y, z)),
            (left_n / self._weight_n, right_n / self._weight_n),
            self._drags(state, observation.foot_forces_n),
            observation.efforts_nm,
            self._acceleration(rotation, observation),
        )

    def _acceleration(self, rotation: Array, observation: Observation) -> Array:
        """Compute the acceleration (3,) of the IMU in the odom frame, with gravity removed."""
        specific = self._robot.imu_in_base @ observation.linear_acceleration_m_s2
        acceleration: Array = rotation @ specific
        acceleration[2] -= GRAVITY_M_S2
        return acceleration

    def _drags(self, state: BodyState, forces_n: Array) -> tuple[Point, Point]:
        """Compute the horizontal parts of forces (2, 3) on the soles, given in their axes."""
        left, right = (
            state.rotation(leg.sole) @ force / self._weight_n
            for leg, force in zip(self._robot.legs, forces_n)
        )
        return complex(left[0], left[1]), complex(right[0], right[1])


def _check(name: str, values: Array, shape: tuple[int, ...]) -> None:
    """Reject a wrong shape or non-finite values."""
    if values.shape != shape:
        raise WalkingError(f'{name} has the shape {values.shape}, but {shape} is needed.')
    # The sum is finite only if all are.
    if not math.isfinite(values.sum()):
        raise WalkingError(f'{name} is {values.tolist()}: give finite numbers.')


class HeadingFrame:
    """
    Heading of the odom frame, whose x axis is the first heading of the base.

    Parameters
    ----------
    imu_in_base
        Rotation matrix (3, 3) from imu_link to base_link.

    """

    def __init__(self, imu_in_base: Array) -> None:
        self._base_in_imu: Array = imu_in_base.T
        self._offset_rad: float | None = None
        self._turn: Array = np.eye(3)

    def base_rotation(self, orientation: Sequence[float] | Array) -> Array:
        """
        Compute the rotation of the base from the orientation that the IMU measures.

        The first call sets the zero of the heading: later ones are relative to it.

        Parameters
        ----------
        orientation
            Orientation of the IMU in the world: a quaternion w, x, y, z of any norm.

        Returns
        -------
        Array
            Rotation matrix (3, 3) from base_link to the odom frame.

        Raises
        ------
        ValueError
            The quaternion is zero or not finite, or it does not have four components.

        """
        rotation: Array = from_quaternion(orientation) @ self._base_in_imu
        if self._offset_rad is None:
            self._offset_rad = yaw_of(rotation)
            self._turn = about_z(-self._offset_rad)
        turned: Array = self._turn @ rotation
        return turned

    def base_rates(self, angular_velocity_rad_s: Array) -> Array:
        """
        Rotate an angular velocity from the axes of the IMU into those of the base.

        Parameters
        ----------
        angular_velocity_rad_s
            As the gyroscope measures it (3,), in the axes of imu_link.

        Returns
        -------
        Array
            Angular velocity (3,) in rad/s, in the axes of base_link.

        """
        rates: Array = self._base_in_imu.T @ angular_velocity_rad_s
        return rates
