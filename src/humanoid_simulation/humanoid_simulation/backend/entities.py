# SPDX-License-Identifier: Apache-2.0
"""States and bounding boxes of the robots and objects in the world."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import product
from typing import Any

from humanoid_control.backends import Array
from humanoid_simulation.backend.floating import floating_body
from humanoid_simulation.backend.names import Names
from humanoid_simulation.choosing import named
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.model.world import ALONE
from humanoid_simulation.rotations import inverse, rotated
import mujoco
import numpy as np

FARTHEST_M = 1e4
"""Largest coordinate; beyond it, floating-point numbers are too coarse for contacts."""
FASTEST_M_S, FASTEST_RAD_S = 1e3, 1e3
_CORNERS = np.array(list(product((-1.0, 1.0), repeat=3)))
"""Corners of the cube from -1 to 1 along each axis, (8, 3)."""


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
                f'The orientation {self.orientation} of an entity is no rotation: the squares of '
                'its four numbers must add up to 1. No rotation is w = 1 and the others 0.'
            )


class Entities:
    """
    The robots and objects of a world by name: their states and bounding boxes.

    Parameters
    ----------
    model, data
        The compiled MuJoCo world, and its state, which `put` changes.
    names
        The names of the entities in this model.

    """

    def __init__(self, model: Any, data: Any, names: Names) -> None:
        self._model, self._data = model, data
        self._floating = {
            name: floating_body(model, joint) for name, joint in names.floating.items()
        }
        self._bodies = {name: names.number(names.body(name)) for name in names.floating}
        self._bodies |= {name: names.number(name) for name in names.fixed}

    @property
    def names(self) -> tuple[str, ...]:
        """Return the names of all entities; those that can be moved come first."""
        return tuple(self._bodies)

    def named(self, name: str) -> str:
        """
        Resolve the name of an entity.

        Parameters
        ----------
        name
            Name of a robot or an object; '' is the robot without a name.

        Returns
        -------
        str
            The name that the other methods accept.

        Raises
        ------
        SimulationError
            There is no such entity.

        """
        name = name or ALONE
        named('entity', name, self._bodies)
        return name

    def state(self, name: str) -> EntityState:
        """
        Read the true pose, velocity and acceleration of an entity, in the world frame.

        Parameters
        ----------
        name
            Name of the entity, as returned by `named`; a fixed one is at rest.

        """
        data = self._data
        if name not in self._floating:
            body = self._bodies[name]
            return EntityState(data.xpos[body].copy(), data.xquat[body].copy())
        at = self._floating[name]
        orientation = data.qpos[at.orientation].copy()
        return EntityState(
            data.qpos[at.position].copy(),
            orientation,
            data.qvel[at.linear].copy(),
            rotated(data.qvel[at.angular], orientation),
            data.qacc[at.linear].copy(),
            rotated(data.qacc[at.angular], orientation),
        )

    def box(self, name: str) -> tuple[Array, Array]:
        """
        Compute the bounding box of an entity, links included, along the axes of its body.

        Parameters
        ----------
        name
            Name of the entity, as returned by `named`; the body of a robot is its base.

        Returns
        -------
        tuple[Array, Array]
            Lower and upper corner (3,) in m, in the frame of that body.

        """
        model, data, body = self._model, self._data, self._bodies[name]
        of_body = model.body_rootid[model.geom_bodyid] == model.body_rootid[body]
        geoms = np.flatnonzero(of_body & (model.geom_rbound > 0.0))
        turns = data.geom_xmat[geoms].reshape(-1, 3, 3)
        corners = model.geom_aabb[geoms, None, :3] + _CORNERS * model.geom_aabb[geoms, None, 3:]
        in_world = corners @ turns.transpose(0, 2, 1) + data.geom_xpos[geoms, None]
        own = (in_world.reshape(-1, 3) - data.xpos[body]) @ data.xmat[body].reshape(3, 3)
        return own.min(axis=0), own.max(axis=0)

    def put(self, name: str, state: EntityState) -> None:
        """
        Set the pose and velocity of an entity; derived quantities are not recomputed.

        Parameters
        ----------
        name
            Name of the entity, as returned by `named`.
        state
            The state of its origin in the world frame; accelerations are ignored.

        Raises
        ------
        SimulationError
            The state is out of bounds, or the entity cannot be moved.

        """
        check_bounds(state)
        at = named('entity that can be moved', name, self._floating)
        qpos, qvel = self._data.qpos, self._data.qvel
        orientation = state.orientation.copy()
        mujoco.mju_normalize4(orientation)
        qpos[at.position], qpos[at.orientation] = state.position_m, orientation
        qvel[at.linear] = state.linear_velocity_m_s
        qvel[at.angular] = rotated(state.angular_velocity_rad_s, inverse(orientation))


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
                f'The {kind} {array} of an entity is too large to be computed with. Give numbers '
                f'from {-most:g} to {most:g}.'
            )
