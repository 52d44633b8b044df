# SPDX-License-Identifier: Apache-2.0
"""Robots and things as bodies that float in the world."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from humanoid_control.backends import Array
from humanoid_simulation.backend.floating import floating_body
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.rotations import inverse, rotated
import mujoco
import numpy as np

FARTHEST_M = 1e4
"""Beyond so far, numbers are too coarse for contacts."""
FASTEST_M_S, FASTEST_RAD_S = 1e3, 1e3


def _zero() -> Array:
    """Return the vector zero."""
    return np.zeros(3)


@dataclass(frozen=True, eq=False)
class EntityState:
    """
    Where the origin of an entity is in the world, and how it moves.

    The orientation is a unit quaternion w, x, y, z; velocities are in world axes.
    """

    position_m: Array
    orientation: Array
    linear_velocity_m_s: Array = field(default_factory=_zero)
    angular_velocity_rad_s: Array = field(default_factory=_zero)

    def __post_init__(self) -> None:
        """Refuse what is no state."""
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
                f'The orientation {self.orientation} of an entity is no rotation: the squares of '
                'its four numbers must add up to 1. No rotation is w = 1 and the others 0.'
            )


class Entities:
    """The bodies of a world that float, by name."""

    def __init__(self, model: Any, data: Any, joints: Mapping[str, str]) -> None:
        """Take the names of the entities, with those of their floating joints."""
        self._data = data
        self._floating = {name: floating_body(model, joint) for name, joint in joints.items()}

    def state(self, name: str) -> EntityState:
        """Return where an entity is."""
        at = self._floating[name]
        qpos, qvel = self._data.qpos, self._data.qvel
        orientation = qpos[at.orientation].copy()
        return EntityState(
            qpos[at.position].copy(),
            orientation,
            qvel[at.linear].copy(),
            rotated(qvel[at.angular], orientation),
        )

    def put(self, name: str, state: EntityState) -> None:
        """Put an entity somewhere; refuse what the physics could not go on from."""
        _check_bounds(state)
        at = self._floating[name]
        qpos, qvel = self._data.qpos, self._data.qvel
        orientation = state.orientation.copy()
        mujoco.mju_normalize4(orientation)
        qpos[at.position], qpos[at.orientation] = state.position_m, orientation
        qvel[at.linear] = state.linear_velocity_m_s
        qvel[at.angular] = rotated(state.angular_velocity_rad_s, inverse(orientation))


def _check_bounds(state: EntityState) -> None:
    """Refuse a state that is beyond what can be computed."""
    for kind, array, most in (
        ('position_m', state.position_m, FARTHEST_M),
        ('linear_velocity_m_s', state.linear_velocity_m_s, FASTEST_M_S),
        ('angular_velocity_rad_s', state.angular_velocity_rad_s, FASTEST_RAD_S),
    ):
        if np.abs(array).max() > most:
            raise SimulationError(
                f'The {kind} {array} of an entity is too large to be computed with. Give numbers '
                f'from {-most:g} to {most:g}.'
            )
