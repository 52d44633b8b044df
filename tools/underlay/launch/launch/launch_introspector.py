# SPDX-License-Identifier: Apache-2.0
"""What a launch description contains, without running it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from launch.action import Action

if TYPE_CHECKING:
    from launch.launch_description import LaunchDescription
    from launch.launch_description_entity import LaunchDescriptionEntity

_STEP = '    '


class LaunchIntrospector:
    """Formatter of the facts that are known about entities before they are visited."""

    def format_launch_description(self, launch_description: LaunchDescription) -> str:
        """
        Format a launch description as an indented tree, without running it.

        Parameters
        ----------
        launch_description
            The description; included files are loaded if that needs no context.

        Returns
        -------
        str
            A line for each entity, indented by its depth.

        """
        return '\n'.join(_lines(launch_description, ()))


def _lines(entity: LaunchDescriptionEntity, locations: tuple[str, ...]) -> Iterator[str]:
    """Yield the lines of an entity and its sub-entities; stop at a circular include."""
    yield _head(entity)
    source = getattr(entity, 'launch_description_source', None)
    if source is not None:
        location = source.location_in_advance() or ''
        if location in locations:
            yield f'{_STEP}(a file that includes itself)'
            return
        locations = (*locations, location)
    for child in entity.describe_sub_entities():
        yield from _indented(_lines(child, locations))
    for reason, children in entity.describe_conditional_sub_entities():
        yield f'{_STEP}{reason}'
        for child in children:
            yield from _indented(_indented(_lines(child, locations)))


def _head(entity: LaunchDescriptionEntity) -> str:
    """Return the description of an entity, or the name of its class with the known facts."""
    if not isinstance(entity, Action) or type(entity).describe is not Action.describe:
        return entity.describe()
    facts = (f'{name}={value}' for name, value in entity.outline().items() if value is not None)
    return f'{type(entity).__name__}({", ".join(facts)})'


def _indented(lines: Iterator[str]) -> Iterator[str]:
    return (_STEP + line for line in lines)
