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
    location = entity.launch_description_source._location_in_advance()
    return location is not None and any(
        each.launch_description_source._location_in_advance() == location for each in includes
    )
