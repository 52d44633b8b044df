# SPDX-License-Identifier: Apache-2.0
"""Requests to load a composable node into a container."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, TYPE_CHECKING

from launch.launch_context import LaunchContext
from launch.utilities.perform_substitutions_impl import perform_substitutions
from launch_ros.actions._node_names import expand_node_names, NodeNames
from launch_ros.actions._ros_arguments import global_parameters, remap_pairs, remap_rules
from launch_ros.utilities.evaluate_parameters_impl import evaluate_parameters
from launch_ros.utilities.parameter_list import named_values, NamedValue, to_ros_parameter

if TYPE_CHECKING:
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
