# SPDX-License-Identifier: Apache-2.0
"""State estimation from observations."""

from __future__ import annotations

from dataclasses import dataclass
import math

from humanoid_control.backends import Array, Observation
from humanoid_control.dynamics import BodyState, DynamicsError
from humanoid_control.dynamics.rotations import to_rpy
from humanoid_control.walking.attitude import Attitude
from humanoid_control.walking.errors import WalkingError
from humanoid_control.walking.heading import HeadingFrame
from humanoid_control.walking.pendulum import GRAVITY_M_S2
from humanoid_control.walking.planar import Point
from humanoid_control.walking.walking_robot import WalkingRobot


@dataclass(frozen=True, eq=False)
class RobotState:
    """Estimated state of the robot at a time, with the heading relative to the odom frame."""

    time_s: float
    state: BodyState
    attitude: Attitude
    loads: tuple[float, float]
    """Normal forces on the soles, as fractions of the weight of the robot."""
    drags: tuple[Point, Point]
    """Horizontal forces on the soles, of the ground or an obstacle, as fractions of the weight."""
    efforts_nm: Array
    """(n,) measured actuator torques"""
    acceleration_m_s2: Array
    """(3,) acceleration of the IMU without gravity, in the axes of the odom frame"""


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
