# SPDX-License-Identifier: Apache-2.0
"""Lookup of remembered objects, and of the positions of objects and places."""

from __future__ import annotations

from typing import Any

from llm_planner.skills import SkillError
from llm_planner.wording import capital
from llm_planner.world import KnownObject, ObjectDescription
from llm_planner.world_watch import WorldWatch

__all__ = ['HEAD_M', 'Recall']

HEAD_M = 1.0
"""Height above the floor of the shoulders, and of the point at which to look in a room; m."""


class Recall:
    """
    Resolver of the descriptions in a plan to remembered objects.

    Parameters
    ----------
    watch
        The observed world, with the remembered objects.

    """

    def __init__(self, watch: WorldWatch) -> None:
        self._watch = watch
        self._found: dict[ObjectDescription, str] = {}
        self._known: set[ObjectDescription] = set()

    def begin_plan(self) -> None:
        """Forget the objects found by the previous plan."""
        self._found.clear()
        self._known.clear()

    def take_found(self, described: ObjectDescription, thing: KnownObject) -> None:
        """
        Bind a description to the object that was found for it, until the plan is over.

        Parameters
        ----------
        described, thing
            The description, and the object.

        """
        self._found[described] = thing.object_id

    def remembered(self, described: ObjectDescription) -> KnownObject | None:
        """
        Find the remembered object that a description means.

        Parameters
        ----------
        described
            The description. An object bound by `take_found` comes first, then the best match.

        Returns
        -------
        KnownObject or None
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

    def thing(self, described: ObjectDescription) -> KnownObject:
        """
        Find the remembered object that a description means, or raise.

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
            An `ObjectDescription`, or the name of an existing surface or room.

        Returns
        -------
        tuple
            The position (3,) in the map frame in m: the centre of an object, the centre of a
            surface, or 1 m above the floor in the centre of a room.

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
