# SPDX-License-Identifier: Apache-2.0
"""Public names of the bodies and entities of a world."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from humanoid_simulation.choosing import named
from humanoid_simulation.model import in_world
from humanoid_simulation.model.robot_spec import FLOATING_BASE
from humanoid_simulation.model.world import ALONE
from humanoid_simulation.scene import Scene


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
        named('entity that can be moved', entity, self.floating)
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
