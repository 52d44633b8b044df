# SPDX-License-Identifier: Apache-2.0
"""Load composable nodes into a container: build the requests and send them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Optional, TYPE_CHECKING

from launch.launch_context import LaunchContext
from launch.logging import get_logger
from launch.utilities import perform_substitutions
from launch_ros.actions._ros_arguments import global_parameters, remap_pairs, remap_rules
from launch_ros.utilities.node_names import expand_node_names, NodeNames
from launch_ros.utilities.parameter_list import named_values, NamedValue, to_ros_parameter
from launch_ros.utilities.parameters_and_remappings import evaluate_parameters

if TYPE_CHECKING:
    import asyncio

    from launch_ros._service_calls import ServiceCaller
    from launch_ros.descriptions.composable_node import ComposableNode


@dataclass(frozen=True)
class LoadRequest:
    """Load request with all substitutions performed."""

    package: str
    plugin: str
    names: NodeNames
    remap_rules: list[str]
    parameters: list[NamedValue]
    extra_arguments: list[NamedValue]

    def as_data(self) -> dict[str, Any]:
        """Return the request as plain data, for display."""
        return {
            'package': self.package,
            'plugin': self.plugin,
            'node_name': self.names.name,
            'node_namespace': self.names.namespace,
            'parameters': dict(self.parameters),
            'remappings': dict(rule.split(':=', 1) for rule in self.remap_rules),
            'extra_arguments': dict(self.extra_arguments),
        }

    def to_message(self) -> Any:
        """Convert to a service request (composition_interfaces/LoadNode)."""
        from composition_interfaces.srv import LoadNode

        return LoadNode.Request(
            package_name=self.package,
            plugin_name=self.plugin,
            node_name=self.names.name or '',
            node_namespace=self.names.namespace or '',
            remap_rules=self.remap_rules,
            parameters=_messages(self.parameters),
            extra_arguments=_messages(self.extra_arguments),
        )


def build_load_request(context: LaunchContext, description: ComposableNode) -> LoadRequest:
    """
    Evaluate the description of a composable node into a request to its container.

    Global parameters precede those of the description.

    Parameters
    ----------
    context
        The launch context, whose configurations hold the namespace, parameters and remappings.
    description
        The node to load.

    Returns
    -------
    LoadRequest
        The request, which no longer depends on the context.

    Raises
    ------
    InvalidNameError
        The name or the namespace is not allowed in ROS.
    FileNotFoundError
        A parameter file is missing.

    """
    package = perform_substitutions(context, description.package)
    plugin = perform_substitutions(context, description.node_plugin)
    names = expand_node_names(
        context,
        description.node_name,
        description.node_namespace,
        f'package={package}, plugin={plugin}, name={_text(description.node_name)}, '
        f'namespace={_text(description.node_namespace)}',
    )
    elements = [
        *global_parameters(context),
        *evaluate_parameters(context, description.parameters),
    ]
    extra_arguments = evaluate_parameters(context, description.extra_arguments)
    return LoadRequest(
        package=package,
        plugin=plugin,
        names=names,
        remap_rules=remap_rules(remap_pairs(context, description.remappings)),
        parameters=named_values(context, elements, names.name_in_root),
        extra_arguments=named_values(context, extra_arguments, names.name_in_root),
    )


def _messages(parameters: list[NamedValue]) -> list[Any]:
    return [to_ros_parameter(name, value).to_parameter_msg() for name, value in parameters]


def _text(parts: Any) -> Any:
    """Return a human-readable description of the parts of a name."""
    return None if parts is None else ' + '.join(part.describe() for part in parts)


class ContainerClient:
    """
    Client that loads composable nodes into a container, in order, and logs each result.

    Parameters
    ----------
    ros_node
        The launch's own rclpy node.
    container
        The fully qualified name of the container.
    process
        Done when the container has ended for good; None if this launch did not start it.

    """

    def __init__(
        self,
        ros_node: Any,
        container: str,
        process: Optional[asyncio.Future[Any]] = None,
    ) -> None:
        from composition_interfaces.srv import LoadNode

        self._service_type = LoadNode
        self._ros_node = ros_node
        self._container = container
        self._process = process
        self._logger = get_logger('launch_ros.actions.load_composable_nodes')
        self._caller: Optional[ServiceCaller] = None

    @property
    def has_asked(self) -> bool:
        """Whether a load request has been sent to the container."""
        return self._caller is not None and self._caller.has_asked

    async def load(self, requests: Iterable[LoadRequest]) -> None:
        """
        Load composable nodes; a failure of one does not affect the others.

        Parameters
        ----------
        requests
            The load requests, in order.

        """
        from launch_ros._service_calls import ServiceCaller

        caller = self._caller = ServiceCaller(
            self._ros_node,
            self._service_type,
            self._container,
            '_container/load_node',
            self._logger,
            self._process,
        )
        try:
            for request in requests:
                await self._load_one(caller, request)
        finally:
            caller.close()

    async def _load_one(self, caller: ServiceCaller, request: LoadRequest) -> None:
        from launch_ros._service_calls import ServiceGoneError

        try:
            answer = await caller.call(request.to_message())
        except ServiceGoneError as error:
            self._report_failure(request, '', str(error))
            return
        if answer.success:
            name = answer.full_node_name or request.names.name_in_root
            self._logger.info("Loaded node '%s' in container '%s'", name, self._container)
        else:
            self._report_failure(request, answer.full_node_name, answer.error_message)

    def _report_failure(self, request: LoadRequest, full_name: str, why: str) -> None:
        self._logger.error(
            "Failed to load node '%s' of type '%s' in container '%s': %s",
            full_name or request.names.name or '',
            request.plugin,
            self._container,
            why,
        )
