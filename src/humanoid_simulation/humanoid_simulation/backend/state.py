# SPDX-License-Identifier: Apache-2.0
"""States of entities, and of a whole MuJoCo model: copy, restore and carry over to another."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from humanoid_control.backends import Array
from humanoid_simulation.errors import SimulationError
import numpy as np

FARTHEST_M = 1e4
"""Largest coordinate; beyond it, floating-point numbers are too coarse for contacts."""
FASTEST_M_S, FASTEST_RAD_S = 1e3, 1e3
_FASTEST = 1e4
"""Norm of `qvel`, in m/s and rad/s, above which a state counts as diverged."""


def _zero() -> Array:
    """Return a zero vector (3,)."""
    return np.zeros(3)


@dataclass(frozen=True, eq=False)
class EntityState:
    """
    Pose, velocity and acceleration of the origin of an entity, in the world frame.

    The orientation is a unit quaternion w, x, y, z; velocities and accelerations are in world
    axes. Accelerations are only reported, never set: they follow from forces.
    """

    position_m: Array
    orientation: Array
    linear_velocity_m_s: Array = field(default_factory=_zero)
    angular_velocity_rad_s: Array = field(default_factory=_zero)
    linear_acceleration_m_s2: Array = field(default_factory=_zero)
    angular_acceleration_rad_s2: Array = field(default_factory=_zero)

    def __post_init__(self) -> None:
        """Check shapes, finite values and the norm of the quaternion."""
        sizes = {
            'position_m': 3,
            'orientation': 4,
            'linear_velocity_m_s': 3,
            'angular_velocity_rad_s': 3,
        }
        for kind, size in sizes.items():
            array = getattr(self, kind)
            if array.shape != (size,) or not np.isfinite(array).all():
                raise SimulationError(
                    f'The {kind} of an entity must be {size} finite numbers, but is {array}.'
                )
        if abs(self.orientation @ self.orientation - 1.0) > 0.01:
            raise SimulationError(
                f'The orientation {self.orientation} of an entity is not a rotation: the squares '
                'of its four numbers must add up to 1. For no rotation, give w = 1 and the others '
                '0.'
            )


def check_bounds(state: EntityState) -> None:
    """
    Check that a state is within the bounds of the physics.

    Parameters
    ----------
    state
        Up to `FARTHEST_M`, `FASTEST_M_S` and `FASTEST_RAD_S` along each axis.

    Raises
    ------
    SimulationError
        The state exceeds one of these bounds.

    """
    for kind, array, most in (
        ('position_m', state.position_m, FARTHEST_M),
        ('linear_velocity_m_s', state.linear_velocity_m_s, FASTEST_M_S),
        ('angular_velocity_rad_s', state.angular_velocity_rad_s, FASTEST_RAD_S),
    ):
        if np.abs(array).max() > most:
            raise SimulationError(
                f'The {kind} {array} of an entity is out of range. Give numbers from {-most:g} to '
                f'{most:g}.'
            )


@dataclass(frozen=True, eq=False)
class Snapshot:
    """Copy of the generalised positions and velocities of MuJoCo at one time."""

    time_s: float
    qpos: Array
    qvel: Array


def carry_over(old: Any, old_data: Any, new: Any, new_data: Any) -> None:
    """
    Copy the states of the joints that two models have in common, by name.

    Parameters
    ----------
    old, old_data
        The model and the state to copy from.
    new, new_data
        The model and the state to copy to; derived quantities are not recomputed.

    """
    known = {old.joint(number).name for number in range(old.njnt)}
    for name in (new.joint(number).name for number in range(new.njnt)):
        if name in known:
            before, joint = old_data.joint(name), new_data.joint(name)
            joint.qpos[:], joint.qvel[:] = before.qpos, before.qvel
            joint.qacc_warmstart[:] = before.qacc_warmstart


def numbers_in(old: Any, new: Any) -> dict[int, int]:
    """
    Map the body ids of a model to those of another one, by name.

    Parameters
    ----------
    old, new
        The two MuJoCo models.

    Returns
    -------
    dict[int, int]
        New ids by the old ones, without the bodies that the new model lacks.

    """
    numbers = {new.body(number).name: number for number in range(new.nbody)}
    names = (old.body(number).name for number in range(old.nbody))
    return {number: numbers[name] for number, name in enumerate(names) if name in numbers}


class LastSound:
    """
    Backup of the state before a step, to restore if the physics becomes unstable.

    Parameters
    ----------
    data
        The MuJoCo state, which is copied immediately.

    """

    def __init__(self, data: Any) -> None:
        self._data = data
        self._qpos, self._qvel = data.qpos.copy(), data.qvel.copy()

    def keep(self) -> None:
        """Save the current state."""
        np.copyto(self._qpos, self._data.qpos)
        np.copyto(self._qvel, self._data.qvel)

    @property
    def is_lost(self) -> bool:
        """Whether the velocities have diverged or are not finite."""
        qvel = self._data.qvel
        return not float(qvel @ qvel) < _FASTEST * _FASTEST

    def restore(self) -> None:
        """Restore the saved state; derived quantities are not recomputed."""
        data = self._data
        data.qpos[:], data.qvel[:] = self._qpos, self._qvel
        data.qacc[:] = data.qacc_warmstart[:] = 0.0


@dataclass(frozen=True)
class Floating:
    """Slices of `qpos` and `qvel`: linear velocity in world axes, angular in body axes."""

    position: slice
    orientation: slice
    linear: slice
    angular: slice


def floating_body(model: Any, joint: str) -> Floating:
    """
    Find the coordinates of a floating body in `qpos` and `qvel`.

    Parameters
    ----------
    model
        The MuJoCo model.
    joint
        Name of the free joint in it.

    """
    found = model.joint(joint)
    at, rate_at = int(found.qposadr[0]), int(found.dofadr[0])
    return Floating(
        slice(at, at + 3),
        slice(at + 3, at + 7),
        slice(rate_at, rate_at + 3),
        slice(rate_at + 3, rate_at + 6),
    )
