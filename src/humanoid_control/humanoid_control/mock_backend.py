# SPDX-License-Identifier: Apache-2.0
"""Backend without physics: joints follow their targets like first-order servos."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from humanoid_control.backends import Array, JointLimits, JointTargets, Observation
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


class ServoBank:
    """
    First-order servos of n joints; every array is (n,).

    Without inertia the actuator's kp (position - q) + kd (velocity - dq) balances the damping d dq
    of the joint, so that q approaches its target exponentially at the rate kp / (kd + d), but no
    faster than the limits of velocity and of effort, effort / d, allow. The motion in a period is
    exact for any length of the period.

    Parameters
    ----------
    drives
        The actuator of each of the n joints, by name and in the order of the arrays.
    home_rad
        Joint positions (n,) at the start and after a reset, clipped to the range of the joints.

    Attributes
    ----------
    positions_rad, velocities_rad_s, efforts_nm
        State of the joints (n,); in m, m/s and N if prismatic.

    """

    def __init__(self, drives: Mapping[str, Drive], home_rad: Array) -> None:
        limits = JointLimits.of(drives, tuple(drives))
        gains = [(each.kp, each.kd, each.damping) for each in drives.values()]
        kp, kd, damping = np.array(gains).T
        self._limits = limits
        self._rate_1_s = kp / (kd + damping)
        self._lead_s = kd / kp
        self._damping = damping
        self._fastest_rad_s = np.minimum(limits.velocity_rad_s, limits.effort_nm / damping)
        self._home_rad = np.clip(home_rad, limits.lower_rad, limits.upper_rad)
        self.reset()

    def reset(self) -> None:
        """Reset the joints to their home positions, at rest."""
        rest = np.zeros_like(self._home_rad)
        self.positions_rad = self._home_rad.copy()
        self.velocities_rad_s = rest.copy()
        self.efforts_nm = rest.copy()
        self.aim(JointTargets(self._home_rad, rest, rest))

    def aim(self, targets: JointTargets) -> None:
        """
        Set new targets for all servos.

        Parameters
        ----------
        targets
            Of the n joints, (n,) each. Efforts cause no motion: they count as loads that the
            servos carry.

        """
        self._aim_rad = targets.positions_rad + self._lead_s * targets.velocities_rad_s
        self._load_nm = targets.efforts_nm

    def move(self, period_s: float) -> None:
        """
        Advance all servos towards their targets.

        Parameters
        ----------
        period_s
            Duration of the period.

        """
        limits = self._limits
        left_rad = self._left_after(self._aim_rad - self.positions_rad, period_s)
        free_rad = self._aim_rad - left_rad
        self.positions_rad = np.clip(free_rad, limits.lower_rad, limits.upper_rad)
        fast_rad_s = np.clip(self._rate_1_s * left_rad, -self._fastest_rad_s, self._fastest_rad_s)
        self.velocities_rad_s = np.where(self.positions_rad == free_rad, fast_rad_s, 0.0)
        self.efforts_nm = np.clip(
            self._load_nm + self._damping * self.velocities_rad_s,
            -limits.effort_nm,
            limits.effort_nm,
        )

    def _left_after(self, left_rad: Array, period_s: float) -> Array:
        """Compute the distance to the targets after a period: full speed first, then decaying."""
        distance_rad = np.abs(left_rad)
        beyond_rad = np.maximum(distance_rad - self._fastest_rad_s / self._rate_1_s, 0.0)
        fast_s = np.minimum(beyond_rad / self._fastest_rad_s, period_s)
        distance_rad = distance_rad - self._fastest_rad_s * fast_s
        distance_rad *= np.exp(-self._rate_1_s * (period_s - fast_s))
        after_rad: Array = np.copysign(distance_rad, left_rad)
        return after_rad
