# SPDX-License-Identifier: Apache-2.0
"""Manipulation skills: pick up objects, put them down, and hand them over."""

from __future__ import annotations

from humanoid_interfaces.action import HandOver, Pick, Place
from llm_planner.recall import Recall
from llm_planner.robot import RobotInterface
from llm_planner.skills import SkillRun
from llm_planner.world import ObjectDescription
from llm_planner.world_watch import WorldWatch

__all__ = ['Handling']


class Handling:
    """
    Manipulation skills that use the actions of the manipulator.

    Parameters
    ----------
    robot, watch, recall
        The interface to the robot, the observed world, and the lookup of remembered objects.

    """

    def __init__(self, robot: RobotInterface, watch: WorldWatch, recall: Recall) -> None:
        self._robot, self._watch, self._recall = robot, watch, recall

    def pick(self, object: ObjectDescription) -> SkillRun:  # noqa: A002
        """
        Pick up an object with the action `pick`.

        Parameters
        ----------
        object
            The description; the remembered object that fits best is picked up.

        Raises
        ------
        SkillError
            No remembered object fits, or the action does not succeed.

        """
        thing = self._recall.thing(object)
        yield from self._robot.act(Pick, 'pick', Pick.Goal(object=thing.object_id))

    def place(self, place: str) -> SkillRun:
        """
        Put down the held object with the action `place`.

        Parameters
        ----------
        place
            The name of a surface; for a room or an empty name, the nearest surface is used.

        Raises
        ------
        SkillError
            The action does not succeed.

        """
        surface = self._watch.surface(place) if place else None
        name = surface.name if surface is not None else ''
        yield from self._robot.act(Place, 'place', Place.Goal(place=name))

    def hand_over(self) -> SkillRun:
        """Hold out the held object until a person takes it."""
        yield from self._robot.act(HandOver, 'hand_over', HandOver.Goal())
