# SPDX-License-Identifier: Apache-2.0
"""The description of what to launch."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Optional, TYPE_CHECKING

from launch.launch_description_entity import LaunchDescriptionEntity

if TYPE_CHECKING:
    from launch.actions.declare_launch_argument import DeclareLaunchArgument
    from launch.actions.include_launch_description import IncludeLaunchDescription
    from launch.launch_context import LaunchContext

    ArgumentWithIncludes = tuple[DeclareLaunchArgument, list[IncludeLaunchDescription]]


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
    ) -> list[DeclareLaunchArgument]:
        """
        List the launch arguments declared here and in included descriptions.

        Parameters
        ----------
        conditional_inclusion
            Whether the description itself is included conditionally.

        Returns
        -------
        list of DeclareLaunchArgument
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
        from launch.launch_introspector import find_arguments

        return find_arguments(self.__entities, conditional_inclusion)
