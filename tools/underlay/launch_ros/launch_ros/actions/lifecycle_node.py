# SPDX-License-Identifier: Apache-2.0
"""Launch action for lifecycle nodes."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Optional, TYPE_CHECKING

from launch.launch_context import LaunchContext
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.substitution import SomeSubstitutionsType
from launch_ros.actions.node import Node

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser


class LifecycleNode(Node):
    """
    Runs a node whose states can be followed (OnStateTransition) and changed (ChangeState).

    Parameters
    ----------
    name, namespace
        Name and namespace, which determine the topic and service of the node's transitions.
    **kwargs
        As for `Node`.

    """

    def __init__(
        self,
        *,
        name: SomeSubstitutionsType,
        namespace: SomeSubstitutionsType,
        **kwargs: Any,
    ) -> None:
        super().__init__(name=name, namespace=namespace, **kwargs)

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
            The `lifecycle_node` element.
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
            The node has no name or no namespace.

        """
        for name in ('name', 'namespace'):
            entity.get_attr(name)
        return super().parse(entity, parser, ignore)

    def execute(self, context: LaunchContext) -> Optional[list[LaunchDescriptionEntity]]:
        """
        Start the node and monitor its transitions from the start.

        Parameters
        ----------
        context
            As for `Node.execute`.

        """
        entities = super().execute(context)
        if not context.is_shutdown and context.run.observer is None:
            from launch_ros.actions._lifecycle_link import LifecycleLink
            from launch_ros.ros_adapters import get_ros_adapter

            LifecycleLink(self, context, get_ros_adapter(context))
        return entities
