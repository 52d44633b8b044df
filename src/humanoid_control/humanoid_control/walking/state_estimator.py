# SPDX-License-Identifier: Apache-2.0
"""What the walk makes of an observation."""

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
    """The robot at a moment, its base turned as in the frame of the odometry."""

    time_s: float
    state: BodyState
    attitude: Attitude
    loads: tuple[float, float]
    """The weight on the soles, as shares of the robot's weight."""
    drags: tuple[Point, Point]
    """The horizontal forces of the ground, or of what else they touch, on the soles, likewise."""
    efforts_nm: Array
    """(n,) what the drives exert"""
    acceleration_m_s2: Array
    """(3,) of the inertial sensor, in the axes of the odometry, without gravity"""


class StateEstimator:
    """
    State estimator that turns each observation into a `RobotState`.

    The first observation sets the zero of the heading.

    Parameters
    ----------
    robot
        The robot, with the dynamics of its body and how the inertial sensor sits in it.

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
            Of the n joints that count for walking, as `WalkingRobot.own` returns it.

        Returns
        -------
        RobotState
            The robot state in the axes of the odom frame: x is the first heading of the base.

        Raises
        ------
        WalkingError
            What the joints, the inertial sensor or the feet say has the wrong shape or is not
            finite.

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
        """Return the acceleration (3,) of the inertial sensor; it measures gravity as well."""
        specific = self._robot.imu_in_base @ observation.linear_acceleration_m_s2
        acceleration: Array = rotation @ specific
        acceleration[2] -= GRAVITY_M_S2
        return acceleration

    def _drags(self, state: BodyState, forces_n: Array) -> tuple[Point, Point]:
        """Return the horizontal parts of forces (2, 3), which are in the axes of the soles."""
        left, right = (
            state.rotation(leg.sole) @ force / self._weight_n
            for leg, force in zip(self._robot.legs, forces_n)
        )
        return complex(left[0], left[1]), complex(right[0], right[1])


def _check(name: str, values: Array, shape: tuple[int, ...]) -> None:
    """Reject a wrong shape and what is not finite."""
    if values.shape != shape:
        raise WalkingError(f'{name} has the shape {values.shape}, but {shape} is needed.')
    # The sum is finite only if all are.
    if not math.isfinite(values.sum()):
        raise WalkingError(f'{name} is {values.tolist()}: give finite numbers.')
