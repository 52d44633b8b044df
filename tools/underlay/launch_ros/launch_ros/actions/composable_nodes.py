# SPDX-License-Identifier: Apache-2.0
"""Launch actions that run a component container, and load composable nodes into one."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Optional, TYPE_CHECKING, Union

from launch.action import Action
from launch.launch_context import LaunchContext
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.substitution import SomeSubstitutionsType, SomeSubstitutionsType_types_tuple
from launch.utilities import (
    ensure_argument_type,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)
from launch_ros.actions.node import Node
from launch_ros.utilities.node_names import UNKNOWN_NAMESPACE, warn_of_same_names

if TYPE_CHECKING:
    import asyncio

    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch_ros.actions._load_request import ContainerClient, LoadRequest
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
        entities: list[LaunchDescriptionEntity] = list(super().execute(context) or ())
        if self.__composable_node_descriptions:
            entities.append(
                LoadComposableNodes(
                    composable_node_descriptions=self.__composable_node_descriptions,
                    target_container=self,
                )
            )
        return entities


class LoadComposableNodes(Action):
    """
    Loads composable nodes into a container that runs or is about to, one after the other.

    They are loaded again whenever a container started by this launch is respawned.

    Parameters
    ----------
    composable_node_descriptions
        The nodes to load, in order.
    target_container
        The action that runs the container, or its fully qualified name.
    **kwargs
        As for `Action`: `condition`.

    Raises
    ------
    TypeError
        The container is neither an action nor a string or substitution.

    """

    def __init__(
        self,
        *,
        composable_node_descriptions: Iterable[ComposableNode],
        target_container: Union[SomeSubstitutionsType, ComposableNodeContainer],
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.__composable_node_descriptions = list(composable_node_descriptions)
        self.__target_container: Any = target_container
        if not isinstance(target_container, ComposableNodeContainer):
            ensure_argument_type(
                target_container,
                (ComposableNodeContainer, *SomeSubstitutionsType_types_tuple),
                'target_container',
                'LoadComposableNodes',
            )
            self.__target_container = normalize_to_list_of_substitutions(target_container)
        self.__task: Optional[asyncio.Task[None]] = None
        self.__client: Optional[ContainerClient] = None

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """
        Parse an element of a launch file into the class and its keyword arguments.

        Parameters
        ----------
        entity
            The `load_composable_node` element, with the attribute `target`.
        parser
            Parses substitutions in its attributes.

        Returns
        -------
        tuple
            The class and the keyword arguments of its constructor.

        """
        from launch_ros.descriptions.composable_node import parse_composable_nodes

        _, kwargs = super().parse(entity, parser)
        kwargs['target_container'] = parser.parse_substitution(entity.get_attr('target'))
        kwargs['composable_node_descriptions'] = parse_composable_nodes(entity, parser)
        return cls, kwargs

    def execute(self, context: LaunchContext) -> None:
        """
        Evaluate the descriptions and start loading the nodes whose conditions hold.

        Loading is asynchronous; the future of `get_asyncio_future` is done when the container has
        responded to all requests.

        Parameters
        ----------
        context
            The launch context used to evaluate conditions and substitutions.

        Raises
        ------
        InvalidNameError
            The name or the namespace of a node is not allowed in ROS.
        FileNotFoundError
            A parameter file is missing.

        """
        requests = self._requests(context)
        if not requests or context.is_shutdown:
            return
        name, process = self._target(context)
        for request in requests:
            if request.names.name is not None:
                warn_of_same_names(context, request.names.name_in_root, name)
        if context.run.observer is not None:
            nodes = [request.as_data() for request in requests]
            context.run.observer.note(target_container=name, composable_nodes=nodes)
        else:
            self._load(context, requests, name, process)
            self._load_after_respawn(context, requests, name)

    def _load_after_respawn(
        self, context: LaunchContext, requests: list[LoadRequest], name: str
    ) -> None:
        """Reload the same nodes whenever this launch respawns the container."""
        from launch.event_handlers.process_event_handlers import OnProcessStart
        from launch_ros._service_calls import STARTED_ANEW
        from launch_ros.actions.node import Node

        full_name = name if name.startswith('/') else f'/{name}'

        def is_container(action: Any) -> bool:
            if not isinstance(action, Node):
                return False
            return action.node_name.replace(UNKNOWN_NAMESPACE, '') == full_name

        def load(event: Any, context: LaunchContext) -> None:
            # Without an earlier request there is nothing to reload.
            if self.__client is None or not self.__client.has_asked or context.is_shutdown:
                return
            if self.__task is not None:
                self.__task.cancel(STARTED_ANEW)
            self._load(context, requests, name, event.action.get_asyncio_future())

        context.register_event_handler(OnProcessStart(target_action=is_container, on_start=load))

    def _load(
        self,
        context: LaunchContext,
        requests: list[LoadRequest],
        name: str,
        process: Optional[asyncio.Future[Any]],
    ) -> None:
        """Start the task that sends load requests to the container."""
        from launch_ros.actions._load_request import ContainerClient
        from launch_ros.ros_adapters import get_ros_adapter

        adapter = get_ros_adapter(context)
        self.__client = ContainerClient(adapter.ros_node, name, process)
        self.__task = adapter.start_task(self.__client.load(requests))

    def _requests(self, context: LaunchContext) -> list[LoadRequest]:
        from launch_ros.actions._load_request import build_load_request

        conditions = [
            description.condition() for description in self.__composable_node_descriptions
        ]
        return [
            build_load_request(context, description)
            for description, condition in zip(self.__composable_node_descriptions, conditions)
            if condition is None or condition.evaluate(context)
        ]

    def _target(self, context: LaunchContext) -> tuple[str, Optional[asyncio.Future[Any]]]:
        """Return the container name and, if this launch started it, its process future."""
        if isinstance(self.__target_container, ComposableNodeContainer):
            return self.__target_container.node_name, self.__target_container.get_asyncio_future()
        return perform_substitutions(context, self.__target_container), None

    def get_asyncio_future(self) -> Optional[asyncio.Future[None]]:
        """Return a future that is done when all nodes have been loaded or have failed."""
        return self.__task
