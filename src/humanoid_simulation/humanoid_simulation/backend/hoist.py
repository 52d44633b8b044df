# SPDX-License-Identifier: Apache-2.0
"""A hoist that lifts a fallen robot onto its feet, and the active hoists of a world."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import Enum
from typing import Any

from humanoid_control.backends import Array
from humanoid_description.rotations import about_z, from_quaternion, log
from humanoid_simulation.backend.forces import Wrench, Wrenches
from humanoid_simulation.backend.state import EntityState
from humanoid_simulation.quaternions import heading_rad
import mujoco
import numpy as np

GRAVITY_M_S2 = 9.81
_ABOVE_M = 0.5
"""Height above the base from which a ray is cast down to find the ground."""
_WORLD_ALONE = np.array([1, 0, 0, 0, 0, 0], dtype=np.uint8)
"""The geom groups of that ray: the world without robots."""


@dataclass(frozen=True)
class HoistSettings:
    """Settings of the hoist, which are scaled by the mass and the height of the robot."""

    lift_m_s: float = 0.5
    """Lifting speed."""
    lower_m_s: float = 0.15
    """Lowering speed."""
    clearance: float = 0.15
    """How far it lifts above the standing height, as a share of that."""
    wait_s: float = 2.5
    """How long it holds the robot up, so that it can assume its standing posture."""
    release_s: float = 1.0
    """Time over which the forces fade out at the release."""
    rate_1_s: float = 6.0
    """Natural frequency of its springs, which are critically damped."""
    gyration: float = 0.6
    """Radius of gyration of the robot, as a share of half its standing height."""
    slack: float = 0.15
    """It releases the robot when it carries less than this share of the weight."""
    upright_rad: float = 0.15
    """Maximum tilt of the robot at which the wait starts."""
    give_up_s: float = 20.0
    """Timeout after which it releases even a robot that does not stand."""


class _Task(Enum):
    """Phase of the hoist."""

    LIFT = 'lift'
    WAIT = 'wait'
    LOWER = 'lower'
    RELEASE = 'release'
    DONE = 'done'


class Hoist:
    """
    Springs and dampers between the base of a robot and a moving suspension point.

    The point rises above where the robot lies, waits there and comes down; meanwhile the base is
    turned upright, with its heading kept. When the feet carry the robot, the hoist releases it.

    Parameters
    ----------
    state
        State of the base when the hoist takes hold of it, in the world frame.
    mass_kg
        Mass of the robot.
    standing_m
        Height of the base above the ground when the robot stands.
    ground_m
        Height of the ground where the robot lies, in the world frame.
    settings
        Speeds, stiffness and durations.

    """

    def __init__(
        self,
        state: EntityState,
        mass_kg: float,
        standing_m: float,
        ground_m: float = 0.0,
        settings: HoistSettings = HoistSettings(),
    ) -> None:
        self._settings, self._mass_kg = settings, mass_kg
        self._inertia_kgm2 = mass_kg * (settings.gyration * standing_m / 2.0) ** 2
        self._standing_m, self._ground_m = standing_m, ground_m
        self._upright = about_z(heading_rad(state.orientation))
        self._goal_m: Array = state.position_m.copy()
        self._task, self._elapsed_s, self._age_s = _Task.LIFT, 0.0, 0.0

    @property
    def is_done(self) -> bool:
        """Whether the hoist has released the robot."""
        return self._task is _Task.DONE

    def wrench(self, state: EntityState, passed_s: float) -> tuple[Array, Array]:
        """
        Compute the wrench on the base for the coming period, and advance the hoist.

        The suspension point moves on, and the hoist enters its next phase when that is due.

        Parameters
        ----------
        state
            Current pose and velocity of the base, in the world frame.
        passed_s
            Simulated time since the last call.

        Returns
        -------
        tuple[Array, Array]
            Force in N and torque in N m (3,), in world axes, on the origin of the base.

        """
        self._elapsed_s += passed_s
        self._age_s += passed_s
        turn = log(self._upright @ from_quaternion(state.orientation).T)
        self._move(passed_s)
        force = self._pull(state)
        self._task = self._next(state, float(np.linalg.norm(turn)), float(force[2]))
        share = self._share
        return share * force, share * self._torque(state, turn)

    @property
    def _share(self) -> float:
        """Return the share of the forces that is applied; it fades to zero during the release."""
        if self._task is _Task.RELEASE:
            return max(0.0, 1.0 - self._elapsed_s / self._settings.release_s)
        return 0.0 if self.is_done else 1.0

    def _move(self, passed_s: float) -> None:
        """Raise or lower the suspension point."""
        s = self._settings
        top_m = self._ground_m + (1.0 + s.clearance) * self._standing_m
        if self._task is _Task.LIFT:
            self._goal_m[2] = min(top_m, self._goal_m[2] + s.lift_m_s * passed_s)
        elif self._task is _Task.LOWER:
            self._goal_m[2] = max(self._ground_m, self._goal_m[2] - s.lower_m_s * passed_s)

    def _pull(self, state: EntityState) -> Array:
        """Compute the spring force with gravity compensation; it never pushes down."""
        rate, off_m = self._settings.rate_1_s, self._goal_m - state.position_m
        force = self._mass_kg * (rate**2 * off_m - 2.0 * rate * state.linear_velocity_m_s)
        force[2] = max(0.0, force[2] + self._mass_kg * GRAVITY_M_S2)
        return force

    def _torque(self, state: EntityState, turn_rad: Array) -> Array:
        """Compute the torque that turns the base upright."""
        rate = self._settings.rate_1_s
        return self._inertia_kgm2 * (
            rate**2 * turn_rad - 2.0 * rate * state.angular_velocity_rad_s
        )

    def _next(self, state: EntityState, tilt_rad: float, lifts_n: float) -> _Task:
        """Determine the phase from now on, and restart its timer if it changes."""
        task = self._following(state, tilt_rad, lifts_n)
        if task is not self._task:
            self._elapsed_s = 0.0
        return task

    def _following(self, state: EntityState, tilt_rad: float, lifts_n: float) -> _Task:
        """Determine the next phase if the current one is complete, else the current one."""
        s, task = self._settings, self._task
        if task is _Task.RELEASE:
            return _Task.DONE if self._elapsed_s >= s.release_s else task
        if self._age_s > s.give_up_s:
            return _Task.RELEASE
        is_up = state.position_m[2] > self._ground_m + self._standing_m
        if task is _Task.LIFT and is_up and tilt_rad < s.upright_rad:
            return _Task.WAIT
        if task is _Task.WAIT and self._elapsed_s >= s.wait_s:
            return _Task.LOWER
        weight_n = self._mass_kg * GRAVITY_M_S2
        if task is _Task.LOWER and lifts_n < s.slack * weight_n:
            return _Task.RELEASE
        return task


class Hoists:
    """
    The active hoists of a world, at most one for each robot.

    Parameters
    ----------
    model, data
        The MuJoCo model, and its state.
    wrenches
        Applies the forces and torques of the hoists.

    """

    def __init__(self, model: Any, data: Any, wrenches: Wrenches) -> None:
        self._model, self._data, self._wrenches = model, data, wrenches
        self._working: dict[int, tuple[Hoist, Callable[[], EntityState]]] = {}

    def enter(self, model: Any, data: Any, numbers: Mapping[int, int]) -> None:
        """
        Switch to another model, in which the bases of the robots may have other ids.

        Parameters
        ----------
        model, data
            The new MuJoCo model, and its state.
        numbers
            New ids of the bodies, by the old ones.

        """
        self._model, self._data = model, data
        self._working = {numbers[base]: hoist for base, hoist in self._working.items()}

    def begin(self, base: int, standing_m: float, state: Callable[[], EntityState]) -> None:
        """
        Start lifting a robot; a hoist that is already lifting it is replaced.

        Parameters
        ----------
        base
            Id of its floating body.
        standing_m
            Height of the base above the ground when the robot stands.
        state
            Returns the state of the base, in the world frame.

        """
        mass_kg = float(self._model.body_subtreemass[base])
        now = state()
        hoist = Hoist(now, mass_kg, standing_m, self._ground_m(now.position_m))
        self._working[base] = (hoist, state)

    def clear(self) -> None:
        """Release all robots immediately."""
        self._working = {}

    def is_lifting(self, base: int) -> bool:
        """
        Check whether a hoist is lifting a robot.

        Parameters
        ----------
        base
            Id of its floating body.

        """
        return base in self._working

    def act(self, period_s: float) -> None:
        """
        Apply the wrenches of all hoists for the coming period, and remove finished hoists.

        Parameters
        ----------
        period_s
            Length of a control period.

        """
        for base, (hoist, state) in list(self._working.items()):
            force, torque = hoist.wrench(state(), period_s)
            if hoist.is_done:
                del self._working[base]
            else:
                wrench = Wrench(base, force, torque, np.zeros(3), period_s)
                self._wrenches.add(wrench, always=True)

    def _ground_m(self, position_m: Array) -> float:
        """Find the height of the ground below a position by ray casting; 0 without a hit."""
        start = position_m + (0.0, 0.0, _ABOVE_M)
        geom, down = np.zeros(1, dtype=np.int32), np.array([0.0, 0.0, -1.0])
        far_m = mujoco.mj_ray(self._model, self._data, start, down, _WORLD_ALONE, 1, -1, geom)
        return float(start[2]) - far_m if far_m >= 0.0 else 0.0
