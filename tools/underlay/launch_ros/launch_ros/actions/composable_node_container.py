# SPDX-License-Identifier: Apache-2.0
"""Launch action for component containers."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Optional, TYPE_CHECKING

from launch.launch_context import LaunchContext
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.some_substitutions_type import SomeSubstitutionsType
from launch_ros.actions.node import Node

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch_ros.descriptions.composable_node import ComposableNode


class ComposableNodeContainer(Node):
    """
    Runs a component container and loads composable nodes into it.

    Parameters
    ----------
    name, namespace
        Name and namespace of the container, which determine its service `load_node`.
    composable_node_descriptions
        The nodes to load, in order; None for none.
    **kwargs
        As for `Node`, such as `package` and `executable` of the container.

    """

    def __init__(
        self,
        *,
        name: SomeSubstitutionsType,
        namespace: SomeSubstitutionsType,
        composable_node_descriptions: Optional[Iterable[ComposableNode]] = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(name=name, namespace=namespace, **kwargs)
        self.__composable_node_descriptions = list(composable_node_descriptions or ())

    @classmethod
    def parse(
        cls,
        entity: Entity,
        parser: Parser,
        ignore: Optional[Iterable[str]] = None,
    ) -> tuple[Any, dict[str, Any]]:
        """
        Parse an element of a launch file into the class and its keyword arguments.

        Parameters
        ----------
        entity
            The `node_container` element, with children `composable_node`.
        parser
            Parses substitutions in its attributes.
        ignore
            Names of attributes that a subclass reads itself.

        Returns
        -------
        tuple
            The class and the keyword arguments of its constructor.

        Raises
        ------
        AttributeError
            The container has no name or no namespace.

        """
        from launch_ros.descriptions.composable_node import parse_composable_nodes

        for name in ('name', 'namespace'):
            entity.get_attr(name)
        _, kwargs = super().parse(entity, parser, ignore)
        kwargs['composable_node_descriptions'] = parse_composable_nodes(entity, parser)
        return cls, kwargs

    @property
    def composable_node_descriptions(self) -> list[ComposableNode]:
        """Return the descriptions of the nodes."""
        return self.__composable_node_descriptions

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """
        Start the container, then load the nodes.

        Parameters
        ----------
        context
            As for `Node.execute`.

        Returns
        -------
        list of LaunchDescriptionEntity
            The action that loads the nodes, if there are any.

        """
        from launch_ros.actions.load_composable_nodes import LoadComposableNodes

        entities: list[LaunchDescriptionEntity] = list(super().execute(context) or ())
        if self.__composable_node_descriptions:
            entities.append(
                LoadComposableNodes(
                    composable_node_descriptions=self.__composable_node_descriptions,
                    target_container=self,
                )
            )
        return entities
