# SPDX-License-Identifier: Apache-2.0
"""The description of what to launch."""

from __future__ import annotations

from collections.abc import Container, Iterable
from typing import Any, Optional, Protocol, TYPE_CHECKING

from launch.launch_description_entity import LaunchDescriptionEntity

if TYPE_CHECKING:
    from launch.failures import CallSite
    from launch.launch_context import LaunchContext
    from launch.substitution import Substitution

    ArgumentWithIncludes = tuple['DeclaredArgument', list['Inclusion']]


class DeclaredArgument(Protocol):
    """The declaration of a launch argument, such as the action `DeclareLaunchArgument`."""

    call_site: Optional[CallSite]
    is_conditional: bool

    @property
    def name(self) -> str:
        """Return the name of the argument."""

    @property
    def default_value(self) -> Optional[list[Substitution]]:
        """Return the default as a list of substitutions, or None if the argument must be given."""

    @property
    def description(self) -> str:
        """Return the description of the argument."""

    @property
    def choices(self) -> Optional[Container[str]]:
        """Return the allowed values, or None if all are allowed."""

    @property
    def condition(self) -> Any:
        """Return the condition of the declaration, or None if there is none."""


class Inclusion(Protocol):
    """An include of a launch description, such as the action `IncludeLaunchDescription`."""

    call_site: Optional[CallSite]

    @property
    def launch_description_source(self) -> Any:
        """Return the source, which tells its location."""

    def given_names(self) -> list[str]:
        """List the names of the launch arguments that are given, as far as they are known."""


class LaunchDescription(LaunchDescriptionEntity):
    """
    Description of what to launch: a list of entities that are visited in order.

    Parameters
    ----------
    initial_entities
        The entities, to which others can be added.
    deprecated_reason
        Why the description is deprecated, logged as a warning when it is visited; None if it is
        not.

    """

    def __init__(
        self,
        initial_entities: Optional[Iterable[LaunchDescriptionEntity]] = None,
        *,
        deprecated_reason: Optional[str] = None,
    ) -> None:
        self.__entities = list(initial_entities) if initial_entities is not None else []
        self.__deprecated_reason = deprecated_reason

    @property
    def entities(self) -> list[LaunchDescriptionEntity]:
        """Return the entities, in the order in which they are visited."""
        return self.__entities

    @property
    def deprecated(self) -> bool:
        """Whether the description is deprecated."""
        return self.__deprecated_reason is not None

    @property
    def deprecated_reason(self) -> Optional[str]:
        """Return the reason for the deprecation, or None."""
        return self.__deprecated_reason

    def add_entity(self, entity: LaunchDescriptionEntity) -> None:
        """
        Append an entity.

        Parameters
        ----------
        entity
            The entity, which is visited after the existing ones.

        """
        self.__entities.append(entity)

    def add_action(self, action: LaunchDescriptionEntity) -> None:
        """
        Append an action; the same as `add_entity`.

        Parameters
        ----------
        action
            The action, or any other entity.

        """
        self.add_entity(action)

    def visit(self, context: LaunchContext) -> Iterable[LaunchDescriptionEntity]:
        """
        Return the entities, which are visited next; warn if the description is deprecated.

        Parameters
        ----------
        context
            The launch context, which knows the launch file for the warning.

        """
        if self.deprecated:
            from launch.logging import get_logger

            file_name = context.get_locals_as_dict().get('current_launch_file_path', 'unknown')
            get_logger().warning(
                'launch file [%s] is deprecated: %s', file_name, self.__deprecated_reason
            )
        return self.__entities

    def describe_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the entities."""
        return self.__entities

    def get_launch_arguments(
        self,
        conditional_inclusion: bool = False,
    ) -> list[DeclaredArgument]:
        """
        List the launch arguments declared here and in included descriptions.

        Parameters
        ----------
        conditional_inclusion
            Whether the description itself is included conditionally.

        Returns
        -------
        list of DeclaredArgument
            The first declaration of each name.

        """
        found = self.get_launch_arguments_with_include_launch_description_actions(
            conditional_inclusion
        )
        return [argument for argument, _ in found]

    def get_launch_arguments_with_include_launch_description_actions(
        self,
        conditional_inclusion: bool = False,
    ) -> list[ArgumentWithIncludes]:
        """
        List the launch arguments, each with the includes that lead to its declaration.

        Parameters
        ----------
        conditional_inclusion
            As for `get_launch_arguments`.

        Returns
        -------
        list of tuple
            The first declaration of each name, and its includes, outermost first.

        """
        return _find_arguments(self.__entities, conditional_inclusion)


def _find_arguments(
    entities: Iterable[LaunchDescriptionEntity],
    conditional: bool,
) -> list[ArgumentWithIncludes]:
    """
    Collect the launch arguments that a tree of entities declares.

    The search is depth-first and goes into included descriptions. The first declaration of a name
    counts. Entities that follow a `ResetLaunchConfigurations` in the same list are not searched.
    Whether the entities are visited conditionally is recorded on the arguments declared directly
    among them.
    """
    found: dict[str, ArgumentWithIncludes] = {}
    _search(entities, conditional, [], found)
    return list(found.values())


def _search(
    entities: Iterable[Any],
    conditional: bool,
    includes: list[Inclusion],
    found: dict[str, ArgumentWithIncludes],
) -> None:
    """
    Search depth-first; stop at a reset of the launch configurations.

    Objects that are not entities are skipped here; visiting them raises an error.
    """
    for entity in entities:
        if not isinstance(entity, LaunchDescriptionEntity):
            continue
        if entity.resets_configurations:
            return
        if entity.declares_argument:
            _note(entity, conditional, includes, found)  # type: ignore[arg-type]
        else:
            _descend(entity, includes, found)


def _note(
    argument: DeclaredArgument,
    conditional: bool,
    includes: list[Inclusion],
    found: dict[str, ArgumentWithIncludes],
) -> None:
    """Record a declaration unless its name has been declared before."""
    if argument.name not in found:
        argument.is_conditional = conditional or argument.condition is not None
        found[argument.name] = (argument, includes)


def _descend(
    entity: Any,
    includes: list[Inclusion],
    found: dict[str, ArgumentWithIncludes],
) -> None:
    """Search the sub-entities; only direct children under a condition count as conditional."""
    if entity.includes_file:
        if _is_inside_itself(entity, includes):
            return
        includes = [*includes, entity]
    _search(entity.describe_sub_entities(), False, includes, found)
    for _, children in entity.describe_conditional_sub_entities():
        _search(children, True, includes, found)


def _is_inside_itself(include: Inclusion, includes: list[Inclusion]) -> bool:
    """Check whether an include refers to a file that is already being searched."""
    location = include.launch_description_source.location_in_advance()
    return location is not None and any(
        each.launch_description_source.location_in_advance() == location for each in includes
    )
