# SPDX-License-Identifier: Apache-2.0
"""Descriptions of the entities of a world, and a search among them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import IntEnum
import re

from humanoid_control.backends import Array
from humanoid_simulation.backend.mujoco_world import MujocoWorld
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.quaternions import rotated
import numpy as np

PERSON = 'person'


class Category(IntEnum):
    """Category of an entity, numbered as in simulation_interfaces/EntityCategory."""

    UNKNOWN = 0
    OBJECT = 1
    ROBOT = 2
    HUMAN = 3
    DYNAMIC_OBJECT = 4
    STATIC_OBJECT = 5


@dataclass(frozen=True)
class Description:
    """Category, text and tags of an entity."""

    category: Category
    text: str = ''
    tags: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class Region:
    """A region of the world: all within a margin of a box, which may be a point."""

    low_m: Array
    high_m: Array
    margin_m: float = 0.0

    def meets(self, low_m: Array, high_m: Array) -> bool:
        """
        Check whether an axis-aligned box comes within the margin of the region.

        Parameters
        ----------
        low_m, high_m
            Lower and upper corner of the box (3,), in the world frame.

        """
        gaps = np.maximum(np.maximum(self.low_m - high_m, low_m - self.high_m), 0.0)
        return bool(gaps @ gaps <= self.margin_m**2)


@dataclass(frozen=True)
class Tags:
    """Filter for tags; without any, all entities match."""

    tags: tuple[str, ...] = ()
    all_of_them: bool = False
    """Whether an entity must have all of the tags rather than any of them."""

    def match(self, tags: Sequence[str]) -> bool:
        """
        Check whether the tags of an entity satisfy the filter.

        Parameters
        ----------
        tags
            The tags that the entity has.

        """
        found = [tag in tags for tag in self.tags]
        return not found or (all(found) if self.all_of_them else any(found))


@dataclass(frozen=True)
class Search:
    """Filter for entities, which must match all criteria that are not empty."""

    pattern: str = ''
    """A regular expression for the whole name."""
    categories: tuple[int, ...] = ()
    tags: Tags = field(default_factory=Tags)
    region: Region | None = field(default=None, compare=False)


class EntityCatalogue:
    """
    Descriptions of the entities of a world, which can be overridden, and a search among them.

    Parameters
    ----------
    backend
        The world.

    """

    def __init__(self, backend: MujocoWorld) -> None:
        self._backend = backend
        self._changed: dict[str, Description] = {}

    def describe(self, entity: str) -> Description:
        """
        Describe an entity: as set by `change`, else from the scene and its current position.

        Parameters
        ----------
        entity
            A name among the entities of the world.

        Returns
        -------
        Description
            Category, a text such as `a red mug, in the kitchen`, and tags: colour, class and room.

        """
        if entity in self._changed:
            return self._changed[entity]
        scene = self._backend.scene
        thing = next((thing for thing in scene.things if thing.name == entity), None)
        if thing is None:
            return Description(Category.ROBOT, 'a humanoid robot', ('robot', 'humanoid'))
        words = [word for word in (thing.colour, thing.kind or thing.shape) if word]
        if thing.kind == PERSON:
            category = Category.HUMAN
        else:
            category = Category.STATIC_OBJECT if thing.is_fixed else Category.DYNAMIC_OBJECT
        state = self._backend.entity_state(entity)
        room = scene.room_at(float(state.position_m[0]), float(state.position_m[1]))
        where = f', in the {room.name.replace("_", " ")}' if room else ''
        article = 'an' if words[0][0] in 'aeiou' else 'a'
        tags = (*words, room.name) if room else tuple(words)
        return Description(category, f'{article} {" ".join(words)}{where}', tags)

    def change(self, entity: str, description: Description) -> None:
        """
        Override the description of an entity.

        Parameters
        ----------
        entity
            A name among the entities of the world.
        description
            What `describe` returns for it, until `forget`.

        """
        self._changed[entity] = description

    def forget(self, entities: Sequence[str] | None = None) -> None:
        """
        Drop overridden descriptions.

        Parameters
        ----------
        entities
            Those that are described from the scene again; None is all of them.

        """
        for entity in list(self._changed) if entities is None else entities:
            self._changed.pop(entity, None)

    def found(self, search: Search) -> list[str]:
        """
        Find the entities that match a filter.

        Parameters
        ----------
        search
            The filter.

        Returns
        -------
        list of str
            Names, in the order of the entities of the world.

        Raises
        ------
        SimulationError
            The pattern is not a regular expression.

        """
        try:
            pattern = re.compile(search.pattern) if search.pattern else None
        except re.error as error:
            raise SimulationError(
                f"The filter '{search.pattern}' is not a valid regular expression: {error}. To "
                "match all names that start with 'red', give 'red.*'."
            ) from error
        return [
            entity
            for entity in self._backend.entities
            if (pattern is None or pattern.fullmatch(entity)) and self._fits(entity, search)
        ]

    def _fits(self, entity: str, search: Search) -> bool:
        """Check whether an entity matches a filter, except for its name."""
        if search.region is not None and not search.region.meets(*self._world_box(entity)):
            return False
        description = self.describe(entity)
        if search.categories and not _is_one_of(description.category, search.categories):
            return False
        return search.tags.match(description.tags)

    def _world_box(self, entity: str) -> tuple[Array, Array]:
        """Compute the corners (3,) of the axis-aligned bounding box of an entity in the world."""
        low_m, high_m = self._backend.entity_box(entity)
        state = self._backend.entity_state(entity)
        middle_m, half_m = (low_m + high_m) / 2.0, (high_m - low_m) / 2.0
        axes = np.array([rotated(axis, state.orientation) for axis in np.eye(3)])
        centre_m, reach_m = state.position_m + middle_m @ axes, half_m @ np.abs(axes)
        return centre_m - reach_m, centre_m + reach_m


def _is_one_of(category: Category, wanted: Sequence[int]) -> bool:
    """Check whether a category is wanted; OBJECT includes dynamic and static objects."""
    is_object = category in (Category.DYNAMIC_OBJECT, Category.STATIC_OBJECT)
    return category in wanted or (is_object and Category.OBJECT in wanted)
