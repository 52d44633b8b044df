# SPDX-License-Identifier: Apache-2.0
"""The robots and objects in the world: their names, states and bounding boxes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import product
from typing import Any

from humanoid_control.backends import Array
from humanoid_simulation.backend.state import check_bounds, EntityState, floating_body
from humanoid_simulation.errors import named
from humanoid_simulation.model.description import ALONE, FLOATING_BASE, in_world
from humanoid_simulation.quaternions import inverse, rotated
from humanoid_simulation.scene.scene import Scene
import mujoco
import numpy as np

_CORNERS = np.array(list(product((-1.0, 1.0), repeat=3)))
"""Corners of the cube from -1 to 1 along each axis, (8, 3)."""


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
        roots = model.body_rootid[model.dof_bodyid]
        self._velocities = {name: roots == self._bodies[name] for name in names.floating}

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

        The entity moves as one rigid body: the joints of a robot keep their positions, and rest.

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
        at = named('movable entity', name, self._floating)
        qpos, qvel = self._data.qpos, self._data.qvel
        orientation = state.orientation.copy()
        mujoco.mju_normalize4(orientation)
        qpos[at.position], qpos[at.orientation] = state.position_m, orientation
        qvel[self._velocities[name]] = 0.0
        qvel[at.linear] = state.linear_velocity_m_s
        qvel[at.angular] = rotated(state.angular_velocity_rad_s, inverse(orientation))


class Names:
    """
    The names of bodies and entities.

    Bodies are the links of robots, prefixed with the robot's name and '/' if it has one, and the
    objects of the scene. Entities are the robots and the objects; only some objects can be moved.

    Parameters
    ----------
    model
        The compiled MuJoCo world.
    scene
        The scene that it was compiled from.
    robots
        Names of the robots; '' for a single one without a name.
    base
        Name of the floating base link, the same in all robots.

    """

    def __init__(self, model: Any, scene: Scene, robots: Sequence[str], base: str) -> None:
        self._robots, self._base = robots, base
        self.bodies = [self._public(model.body(number).name) for number in range(model.nbody)]
        self._numbers = {name: number for number, name in enumerate(self.bodies)}
        self._roots = model.body_rootid
        things = {thing.name: thing.name for thing in scene.things if not thing.is_fixed}
        self.floating: Mapping[str, str] = {
            **{robot or ALONE: in_world(robot, FLOATING_BASE) for robot in robots},
            **things,
        }
        """The free joint of each entity that can be moved, by the name of the entity."""
        self.fixed = tuple(thing.name for thing in scene.things if thing.is_fixed)
        """The entities that are fixed in the world."""

    def body(self, entity: str, link: str = '') -> str:
        """
        Look up the name of a body: a link of a robot, or an object.

        Parameters
        ----------
        entity
            Name of a robot or of an object that can be moved; '' is the robot without a name.
        link
            A link of the robot, which is not checked; '' is its base, or the object.

        Raises
        ------
        SimulationError
            There is no such entity, or it is fixed.

        """
        entity = entity or ALONE
        named('movable entity', entity, self.floating)
        if entity == ALONE and '' in self._robots:
            return link or self._base
        if entity in self._robots:
            return f'{entity}/{link or self._base}'
        return f'{entity}/{link}' if link else entity

    def number(self, body: str) -> int:
        """
        Look up the id of a body in the MuJoCo model.

        Parameters
        ----------
        body
            Its name, one of `bodies`.

        Raises
        ------
        SimulationError
            There is no such body.

        """
        return named('body', body, self._numbers)

    def links(self, robot: str) -> list[str]:
        """
        List the names of the bodies of a robot.

        Parameters
        ----------
        robot
            Name of the robot; '' if it has none.

        Raises
        ------
        SimulationError
            There is no such robot.

        """
        root = self._roots[self.number(self.body(robot))]
        return [name for name, of in zip(self.bodies, self._roots) if of == root]

    def _public(self, name: str) -> str:
        """Convert a MuJoCo body name: the prefix of a robot without a name is dropped."""
        return name.removeprefix(f'{ALONE}/') if '' in self._robots else name
