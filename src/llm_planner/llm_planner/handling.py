# SPDX-License-Identifier: Apache-2.0
"""Manipulation skills: pick up objects, put them down, hand them over, and tidy up a place."""

from __future__ import annotations

from humanoid_interfaces.action import HandOver, Pick, Place
from llm_planner.looking import Looking
from llm_planner.recall import Recall
from llm_planner.robot import RobotInterface
from llm_planner.skills import SkillError, SkillRun
from llm_planner.walking import Walking
from llm_planner.wording import capital
from llm_planner.world import in_words, KnownObject, listed, ObjectDescription
from llm_planner.world_watch import WorldWatch

__all__ = ['Handling', 'Tidying']


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


class Tidying:
    """
    Skill that clears a place by carrying its objects, one after another, to another place.

    Parameters
    ----------
    robot, watch
        The interface to the robot, and the observed world.
    walking, looking, handling
        The skills used to go there, look at the objects, and carry them.

    """

    def __init__(
        self,
        robot: RobotInterface,
        watch: WorldWatch,
        walking: Walking,
        looking: Looking,
        handling: Handling,
    ) -> None:
        self._robot, self._watch = robot, watch
        self._walking, self._looking, self._handling = walking, looking, handling

    def tidy(self, place: str, destination: str) -> SkillRun:
        """
        Clear a place by carrying its objects to a destination.

        Objects that cannot be picked up stay there; the others are carried all the same.

        Parameters
        ----------
        place, destination
            The place to clear, and where to put the objects; names of surfaces or rooms.

        Raises
        ------
        SkillError
            Nothing is there, something was left, or the held object cannot be put down.

        """
        if place == destination:
            raise SkillError('That is where I would carry everything.', is_final=True)
        yield from self._walking.go_to(place)
        yield from self._looking.look_over(place)
        tried: set[str] = set()
        moved: list[str] = []
        left: list[str] = []
        while (thing := self._next(place, tried)) is not None:
            tried.add(thing.object_id)
            try:
                yield from self._handling.pick(
                    ObjectDescription(thing.class_id, thing.colour, object_id=thing.object_id)
                )
            except SkillError as error:
                if error.code == 'UNAVAILABLE' or self._watch.holding:
                    raise
                left.append(f'{capital(f"the {thing.name}")} is still there. {error}')
                continue
            yield from self._walking.go_to(destination)
            yield from self._handling.place(destination)
            moved.append(f'the {thing.name}')
        if not tried:
            where = in_words(place)
            raise SkillError(f'I see nothing at the {where} that I could tidy.', is_final=True)
        done = f'I have moved {listed(moved)}. ' if moved else ''
        if left:
            raise SkillError(done + ' '.join(left), is_final=True)
        self._robot.say(done.strip())

    def _next(self, place: str, tried: set[str]) -> KnownObject | None:
        """Return an object at a place that was not tried yet; None if there is none."""
        everything = ObjectDescription(place=place)
        return next(
            (
                each
                for each in everything.among(self._watch.things, self._watch.pose())
                if each.object_id not in tried
            ),
            None,
        )
