# SPDX-License-Identifier: Apache-2.0
"""A hoist that puts a fallen robot onto its feet."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from humanoid_control.backends import Array
from humanoid_control.dynamics.rotations import about_z, from_quaternion, log
from humanoid_simulation.backend.entities import EntityState
from humanoid_simulation.rotations import heading_rad
import numpy as np

GRAVITY_M_S2 = 9.81


@dataclass(frozen=True)
class HoistSettings:
    """How the hoist works; scaled by the mass and the height of what it lifts."""

    lift_m_s: float = 0.5
    """How fast it pulls up."""
    lower_m_s: float = 0.15
    """How fast it lets down."""
    clearance: float = 0.15
    """How high it lifts above the height of standing, as a share of that."""
    wait_s: float = 2.5
    """How long it keeps the robot up there, so that it can take the posture of standing."""
    release_s: float = 1.0
    """How long it takes to let go."""
    rate_1_s: float = 6.0
    """The natural frequency of its springs; they are damped critically."""
    gyration: float = 0.6
    """The radius of gyration of what it lifts, as a share of its height."""
    slack: float = 0.15
    """It lets go when it carries less than this share of the weight."""
    upright_rad: float = 0.15
    """How well upright the robot has to be before the wait begins."""
    give_up_s: float = 20.0
    """When it lets go even of a robot that does not stand."""


class _Task(Enum):
    """What the hoist does."""

    LIFT = 'lift'
    WAIT = 'wait'
    LOWER = 'lower'
    RELEASE = 'release'
    DONE = 'done'


class Hoist:
    """
    Springs and dampers between the base of a robot and a point that moves.

    The point goes up above where the robot lies, waits there and comes down; meanwhile the base
    is turned upright, facing where it faced. When the feet carry the robot, the hoist lets go.

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
        """Tell whether the hoist has let go."""
        return self._task is _Task.DONE

    def wrench(self, state: EntityState, passed_s: float) -> tuple[Array, Array]:
        """
        Compute the wrench on the base for the coming period, and advance the hoist.

        The suspension point moves on, and the hoist goes over to its next phase when that is due.

        Parameters
        ----------
        state
            Pose and velocity of the base now, in the world frame.
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
        """Return the share of the forces that act; it falls to zero at the end."""
        if self._task is _Task.RELEASE:
            return max(0.0, 1.0 - self._elapsed_s / self._settings.release_s)
        return 0.0 if self.is_done else 1.0

    def _move(self, passed_s: float) -> None:
        """Let the point go up or down."""
        s = self._settings
        top_m = self._ground_m + (1.0 + s.clearance) * self._standing_m
        if self._task is _Task.LIFT:
            self._goal_m[2] = min(top_m, self._goal_m[2] + s.lift_m_s * passed_s)
        elif self._task is _Task.LOWER:
            self._goal_m[2] = max(self._ground_m, self._goal_m[2] - s.lower_m_s * passed_s)

    def _pull(self, state: EntityState) -> Array:
        """Return the force of the springs, which also carries the weight while it lifts."""
        rate, off_m = self._settings.rate_1_s, self._goal_m - state.position_m
        force = self._mass_kg * (rate**2 * off_m - 2.0 * rate * state.linear_velocity_m_s)
        force[2] = max(0.0, force[2] + self._mass_kg * GRAVITY_M_S2)
        return force

    def _torque(self, state: EntityState, turn_rad: Array) -> Array:
        """Return the torque that turns the base upright."""
        rate = self._settings.rate_1_s
        return self._inertia_kgm2 * (
            rate**2 * turn_rad - 2.0 * rate * state.angular_velocity_rad_s
        )

    def _next(self, state: EntityState, tilt_rad: float, lifts_n: float) -> _Task:
        """Return what to do from now on."""
        task = self._following(state, tilt_rad, lifts_n)
        if task is not self._task:
            self._elapsed_s = 0.0
        return task

    def _following(self, state: EntityState, tilt_rad: float, lifts_n: float) -> _Task:
        """Return what follows what is done now, if that is complete."""
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
