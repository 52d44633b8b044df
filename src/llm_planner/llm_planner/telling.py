# SPDX-License-Identifier: Apache-2.0
"""Skills that answer questions about remembered objects by speech."""

from __future__ import annotations

import math
from typing import Any

from llm_planner.looking import Looking
from llm_planner.recall import Recall
from llm_planner.robot import RobotInterface
from llm_planner.skills import SkillRun
from llm_planner.walking import Walking
from llm_planner.wording import capital, enumerated, NUMBERS, where_is, with_article
from llm_planner.world import base_name, in_words, KnownObject, ObjectDescription
from llm_planner.world_watch import WorldWatch

__all__ = ['Telling']

_NEAR_M = 0.6
"""Objects that are at most this far apart are beside each other."""
_CLOSE_M = 1.5
"""If it can walk, the robot approaches a target that is farther away before describing it."""


class Telling:
    """
    Skills that answer questions about objects by speech.

    Parameters
    ----------
    robot, watch, recall
        The interface to the robot, the observed world, and the lookup of remembered objects.
    walking, looking
        The skills used to look at a target again before it is described.

    """

    def __init__(
        self,
        robot: RobotInterface,
        watch: WorldWatch,
        recall: Recall,
        walking: Walking,
        looking: Looking,
    ) -> None:
        self._robot, self._watch, self._recall = robot, watch, recall
        self._walking, self._looking = walking, looking

    def where(self, object: ObjectDescription) -> SkillRun:  # noqa: A002
        """
        Report the location of an object.

        Parameters
        ----------
        object
            The description; it may refer to the held object.

        Raises
        ------
        SkillError
            No remembered object fits.

        """
        if object.names(self._watch.holding):
            self._robot.say(f'I am holding the {self._watch.holding}.')
            return
        thing = self._recall.thing(object)
        self._robot.say(f'The {thing.name} is{where_is(thing) or " where I last saw it"}.')
        return
        yield

    def identify(self, object: ObjectDescription) -> SkillRun:  # noqa: A002
        """
        Report which object is meant, and its location.

        Parameters
        ----------
        object
            The description.

        Raises
        ------
        SkillError
            No remembered object fits.

        """
        thing = self._recall.thing(object)
        self._robot.say(f'It is {with_article(thing.name)}{where_is(thing)}.')
        return
        yield

    def tell_count(self, objects: ObjectDescription) -> SkillRun:
        """
        Report the number of remembered objects that fit a description.

        Parameters
        ----------
        objects
            The description.

        """
        count = len(objects.among(self._watch.things))
        one = ObjectDescription(
            objects.class_id, objects.colour, '', objects.place, is_inside=objects.is_inside
        )
        number = NUMBERS[count] if count < len(NUMBERS) else str(count)
        if count == 1:
            self._robot.say(f'There is one{one.text.removeprefix("the")}.')
        else:
            self._robot.say(f'There are {number} {objects.plural_text}.')
        return
        yield

    def describe(self, target: Any, relation: str) -> SkillRun:
        """
        Report what is here, at a place, or beside an object; go there and look first.

        Parameters
        ----------
        target
            The name of a place, or the description of an object; empty for the current room.
        relation
            `beside` or `at`. Only the plan in words has it: what is told are the objects beside an
            object, or at a place, whatever was asked.

        """
        things = self._watch.things
        if not target:
            pose = self._watch.pose()
            room = self._watch.places.room_at(pose[0], pose[1]) if pose else ''
            seen = [each for each in things if each.room == room] if room else list(things)
            where = f'In the {in_words(room)} I see' if room else 'I see'
            self._robot.say(f'{where} {enumerated(seen) or "nothing that I recognise"}.')
            return
        position_m, pose = self._recall.position(target), self._watch.pose()
        is_far = pose is not None and math.dist(pose[:2], position_m[:2]) > _CLOSE_M
        if is_far and not self._watch.lacks('go_to'):
            yield from self._walking.go_to(target)
        yield from self._looking.glance_at(position_m)
        things = self._watch.things
        if isinstance(target, ObjectDescription):
            thing = self._recall.thing(target)
            beside = [each for each in things if _are_neighbours(thing, each)]
            beside.sort(key=lambda each: math.dist(each.position_m, thing.position_m))
            verb = 'is' if len(beside) == 1 else 'are'
            text = f'{capital(enumerated(beside) or "nothing")} {verb} beside the {thing.name}.'
            self._robot.say(text if beside else f'There is nothing beside the {thing.name}.')
            return
        there = [each for each in things if target in (base_name(each.place), each.room)]
        where = f'{"In" if self._watch.room(target) else "On"} the {in_words(target)}'
        self._robot.say(f'{where} I see {enumerated(there) or "nothing that I recognise"}.')


def _are_neighbours(one: KnownObject, other: KnownObject) -> bool:
    if one.object_id == other.object_id or base_name(one.place) != base_name(other.place):
        return False
    return math.dist(one.position_m, other.position_m) <= _NEAR_M
