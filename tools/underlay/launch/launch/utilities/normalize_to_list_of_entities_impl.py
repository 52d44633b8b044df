# SPDX-License-Identifier: Apache-2.0
"""Normalise entities to a list."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Optional

from launch.launch_description_entity import LaunchDescriptionEntity
from launch.some_entities_type import SomeEntitiesType


def normalize_to_list_of_entities(
    entities: Optional[SomeEntitiesType],
) -> list[LaunchDescriptionEntity]:
    """
    Normalise entities to a flat list without None.

    Parameters
    ----------
    entities
        An entity, an iterable of entities that may be nested, or None.

    Raises
    ------
    RuntimeError
        The argument contains something else.

    """
    flat: list[LaunchDescriptionEntity] = []
    _flatten(entities, flat)
    return flat


def _flatten(item: Any, into: list[LaunchDescriptionEntity]) -> None:
    if item is None:
        return
    if isinstance(item, LaunchDescriptionEntity):
        into.append(item)
    elif isinstance(item, Iterable) and not isinstance(item, str):
        for each in item:
            _flatten(each, into)
    else:
        raise RuntimeError(
            'expected a LaunchDescriptionEntity, a list of them or None as the reaction to an '
            f"event, but got '{item!r}' of type '{type(item).__name__}'"
        )
