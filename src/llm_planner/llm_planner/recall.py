# SPDX-License-Identifier: Apache-2.0
"""Which remembered thing is meant, and where it is."""

from __future__ import annotations

from typing import Any

from llm_planner.plan_tree import SkillError
from llm_planner.wording import capital
from llm_planner.world import ObjectDescription, Thing
from llm_planner.world_watch import WorldWatch

__all__ = ['HEAD_M', 'Recall']

HEAD_M = 1.0
"""How high above the floor a room is looked at, and the shoulders are; m."""


class Recall:
    """
    Finds what a plan speaks of among the remembered things.

    Parameters
    ----------
    watch
        What is remembered.

    """

    def __init__(self, watch: WorldWatch) -> None:
        self._watch = watch
        self._found: dict[ObjectDescription, str] = {}
        self._known: set[ObjectDescription] = set()

    def begin_plan(self) -> None:
        """Forget what the plan before has found."""
        self._found.clear()
        self._known.clear()

    def take_found(self, described: ObjectDescription, thing: Thing) -> None:
        """
        Take note of which thing it is that a description means until the plan is over.

        Parameters
        ----------
        described, thing
            The words, and the thing that was found for them.

        """
        self._found[described] = thing.object_id

    def remembered(self, described: ObjectDescription) -> Thing | None:
        """
        Find the remembered object that a description means.

        Parameters
        ----------
        described
            The description. What `take_found` has set for it comes first, then what fits best.

        Returns
        -------
        Thing or None
            None if no remembered object fits.

        """
        things = self._watch.things
        known = self._found.get(described)
        found = next((each for each in things if each.object_id == known), None)
        if found is None:
            found = next(iter(described.among(things, self._watch.pose())), None)
        if found is not None:
            self._known.add(described)
        return found

    def thing(self, described: ObjectDescription) -> Thing:
        """
        Find the remembered object that a description means, or fail.

        Parameters
        ----------
        described
            The description; see `remembered`.

        Raises
        ------
        SkillError
            No remembered object fits.

        """
        thing = self.remembered(described)
        if thing is None:
            text = f'I do not remember {described.text}.'
            if described in self._known:
                text = f'{capital(described.text)} is not there any more.'
            raise SkillError(text, is_final=True)
        return thing

    def position(self, target: Any) -> tuple[float, float, float]:
        """
        Look up the position of an object or a place.

        Parameters
        ----------
        target
            An `ObjectDescription`, or the name of a surface or room that there is.

        Returns
        -------
        tuple
            The position (3,) in the map frame in m: the centre of an object, the middle of a
            surface, or 1 m above the floor in the middle of a room.

        Raises
        ------
        SkillError
            No remembered object fits.

        """
        if isinstance(target, ObjectDescription):
            return self.thing(target).position_m
        if surface := self._watch.surface(target):
            return (*surface.middle_m, surface.height_m)
        room = self._watch.room(target)
        assert room is not None, 'The plan was checked.'
        return (*room.middle_m, HEAD_M)
