# SPDX-License-Identifier: Apache-2.0
"""Backend without physics: joints follow their targets within the limits."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from humanoid_control.backends.interface import Array, JointTargets, Observation
from humanoid_control.backends.servo import ServoBank
from humanoid_description.drives import Drive
import numpy as np

GRAVITY_M_S2 = 9.81
KEYFRAME = 'home'


class MockBackend:
    """
    Backend without physics: first-order servos, and bodies suspended upright in the air.

    The feet share the weight, the IMU is level and at rest, and the load of each joint equals its
    target effort.

    Parameters
    ----------
    drives
        The actuator of each joint, by name, in the order of observations and targets.
    robots
        Names of the robots; '' is a single robot.
    period_s
        The control period, by which each step advances.
    mass_kg
        Mass of a robot; each foot carries half of its weight.
    home_rad
        Joint positions at the start and after a reset, by name; joints that are not named are at
        zero. All are clipped to the range of the joint.
    start_s
        Time of the first observation.

    """

    def __init__(
        self,
        drives: Mapping[str, Drive],
        robots: Sequence[str] = ('',),
        period_s: float = 0.01,
        mass_kg: float = 0.0,
        home_rad: Mapping[str, float] = {},
        start_s: float = 0.0,
    ) -> None:
        self._robots, self._joints = tuple(robots), tuple(drives)
        self._period_s, self._start_s = period_s, start_s
        self._weight_n = mass_kg * GRAVITY_M_S2
        home = np.array([home_rad.get(joint, 0.0) for joint in self._joints])
        self._banks = {robot: ServoBank(drives, home) for robot in robots}
        self._steps = 0

    @property
    def robots(self) -> tuple[str, ...]:
        """Return the names of the robots."""
        return self._robots

    @property
    def joints(self) -> tuple[str, ...]:
        """Return the names of the actuated joints."""
        return self._joints

    @property
    def period_s(self) -> float:
        """Return the duration of a step."""
        return self._period_s

    def observe(self) -> dict[str, Observation]:
        """Read the sensors of every robot."""
        return {robot: self._observed(bank) for robot, bank in self._banks.items()}

    def step(self, targets: Mapping[str, JointTargets]) -> None:
        """
        Advance all joints by one period.

        Parameters
        ----------
        targets
            As for `Backend.step`.

        """
        for robot, target in targets.items():
            self._banks[robot].aim(target)
        for bank in self._banks.values():
            bank.move(self._period_s)
        self._steps += 1

    def reset(self, keyframe: str = KEYFRAME) -> None:
        """
        Reset all joints to their home positions, at rest; time continues.

        Parameters
        ----------
        keyframe
            The name of the posture: only `home` is known.

        Raises
        ------
        ValueError
            The posture is unknown.

        """
        if keyframe != KEYFRAME:
            raise ValueError(
                f"The mock has no posture '{keyframe}': it knows '{KEYFRAME}' alone. "
                'Reset to that one, or use the simulator.'
            )
        for bank in self._banks.values():
            bank.reset()

    def close(self) -> None:
        """Release nothing: the mock holds no resources."""

    def _observed(self, bank: ServoBank) -> Observation:
        return Observation(
            time_s=self._start_s + self._steps * self._period_s,
            positions_rad=bank.positions_rad.copy(),
            velocities_rad_s=bank.velocities_rad_s.copy(),
            efforts_nm=bank.efforts_nm.copy(),
            orientation=np.array([1.0, 0.0, 0.0, 0.0]),
            angular_velocity_rad_s=np.zeros(3),
            linear_acceleration_m_s2=np.array([0.0, 0.0, GRAVITY_M_S2]),
            foot_forces_n=self._share_of_weight(),
            foot_torques_nm=np.zeros((2, 3)),
        )

    def _share_of_weight(self) -> Array:
        """Compute the ground reaction force on each foot, (2, 3)."""
        forces_n = np.zeros((2, 3))
        forces_n[:, 2] = self._weight_n / 2.0
        return forces_n
