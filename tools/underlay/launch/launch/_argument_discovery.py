# SPDX-License-Identifier: Apache-2.0
"""Find the launch arguments that a description declares."""

from __future__ import annotations

from collections.abc import Iterable

from launch.actions.declare_launch_argument import DeclareLaunchArgument
from launch.actions.include_launch_description import IncludeLaunchDescription
from launch.actions.reset_launch_configurations import ResetLaunchConfigurations
from launch.launch_description_entity import LaunchDescriptionEntity

Found = dict[str, tuple[DeclareLaunchArgument, list[IncludeLaunchDescription]]]


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
        Where to search, in the order in which they are visited.
    conditional
        Whether they are visited under a condition only, which is noted on the arguments declared
        directly among them.

    Returns
    -------
    list of tuple
        Each declaration, with the includes that lead to it, the outermost first.

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
    Search depth-first; behind a reset of the configurations nothing can be told.

    What is no entity is an error when it is visited, not here.
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
    """Keep the declaration unless its name is known already."""
    if argument.name not in found:
        argument._conditionally_included = conditional or argument.condition is not None
        found[argument.name] = (argument, includes)


def _descend(
    entity: LaunchDescriptionEntity,
    includes: list[IncludeLaunchDescription],
    found: Found,
) -> None:
    """Search what an entity brings in; only its direct children count as conditional."""
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
    """Return whether a file is included that is being searched already."""
    location = entity.launch_description_source._location_in_advance()
    return location is not None and any(
        each.launch_description_source._location_in_advance() == location for each in includes
    )
