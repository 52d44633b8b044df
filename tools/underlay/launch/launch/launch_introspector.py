# SPDX-License-Identifier: Apache-2.0
"""What a launch description contains, without running it: its tree, and its launch arguments."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from launch.action import Action
from launch.actions.declare_launch_argument import DeclareLaunchArgument
from launch.actions.include_launch_description import IncludeLaunchDescription
from launch.actions.reset_launch_configurations import ResetLaunchConfigurations
from launch.launch_description_entity import LaunchDescriptionEntity

if TYPE_CHECKING:
    from launch.launch_description import LaunchDescription

_STEP = '    '

Found = dict[str, tuple[DeclareLaunchArgument, list[IncludeLaunchDescription]]]


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


def find_arguments(
    entities: Iterable[LaunchDescriptionEntity],
    conditional: bool,
) -> list[tuple[DeclareLaunchArgument, list[IncludeLaunchDescription]]]:
    """
    Collect the launch arguments that a tree of entities declares.

    The search is depth-first and goes into included descriptions. The first declaration of a name
    counts. Entities that follow a `ResetLaunchConfigurations` in the same list are not searched.

    Parameters
    ----------
    entities
        The entities to search, in visiting order.
    conditional
        Whether they are visited conditionally; this is recorded on the arguments declared
        directly among them.

    Returns
    -------
    list of tuple
        Each declaration with the includes that lead to it, outermost first.

    """
    found: Found = {}
    _search(entities, conditional, [], found)
    return list(found.values())


def _search(
    entities: Iterable[LaunchDescriptionEntity],
    conditional: bool,
    includes: list[IncludeLaunchDescription],
    found: Found,
) -> None:
    """
    Search depth-first; stop at a reset of the launch configurations.

    Objects that are not entities are skipped here; visiting them raises an error.
    """
    for entity in entities:
        if isinstance(entity, ResetLaunchConfigurations):
            return
        if isinstance(entity, DeclareLaunchArgument):
            _note(entity, conditional, includes, found)
        elif isinstance(entity, LaunchDescriptionEntity):
            _descend(entity, includes, found)


def _note(
    argument: DeclareLaunchArgument,
    conditional: bool,
    includes: list[IncludeLaunchDescription],
    found: Found,
) -> None:
    """Record a declaration unless its name has been declared before."""
    if argument.name not in found:
        argument._conditionally_included = conditional or argument.condition is not None
        found[argument.name] = (argument, includes)


def _descend(
    entity: LaunchDescriptionEntity,
    includes: list[IncludeLaunchDescription],
    found: Found,
) -> None:
    """Search the sub-entities; only direct children under a condition count as conditional."""
    if isinstance(entity, IncludeLaunchDescription):
        if _is_inside_itself(entity, includes):
            return
        includes = [*includes, entity]
    _search(entity.describe_sub_entities(), False, includes, found)
    for _, children in entity.describe_conditional_sub_entities():
        _search(children, True, includes, found)


def _is_inside_itself(
    entity: IncludeLaunchDescription,
    includes: list[IncludeLaunchDescription],
) -> bool:
    """Check whether an include refers to a file that is already being searched."""
    location = entity.launch_description_source.location_in_advance()
    return location is not None and any(
        each.launch_description_source.location_in_advance() == location for each in includes
    )
