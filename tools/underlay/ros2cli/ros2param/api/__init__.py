# SPDX-License-Identifier: Apache-2.0
"""The parameters of a node, asked for through its services."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Any

from rcl_interfaces.msg import Parameter, ParameterDescriptor, ParameterValue, SetParametersResult
from rcl_interfaces.srv import DescribeParameters, GetParameters, ListParameters, SetParameters
from ros2cli.node.calls import call

__all__ = [
    'LIST_SERVICE',
    'LIST_TYPE',
    'describe_parameters',
    'get_parameters',
    'list_parameters',
    'set_parameter',
    'unknown_parameter_hint',
    'unknown_parameter_text',
]

LIST_SERVICE = '/list_parameters'
LIST_TYPE = 'rcl_interfaces/srv/ListParameters'


def list_parameters(
    node: Any, node_name: str, prefixes: Sequence[str] = (), timeout_s: float = float('inf')
) -> list[str]:
    """Return the names of a node's parameters, sorted; all, or those with a prefix."""
    request = ListParameters.Request(prefixes=prefixes)
    response = call(node, ListParameters, f'{node_name}{LIST_SERVICE}', request, timeout_s)
    return sorted(response.result.names)


def get_parameters(node: Any, node_name: str, names: list[str]) -> list[ParameterValue]:
    """Return the values of parameters; that of an unknown one is not set."""
    request = GetParameters.Request(names=names)
    values = list(call(node, GetParameters, f'{node_name}/get_parameters', request).values)
    if len(values) == len(names):
        return values
    if len(names) == 1:
        return [ParameterValue()]
    return [value for name in names for value in get_parameters(node, node_name, [name])]


def describe_parameters(node: Any, node_name: str, names: list[str]) -> list[ParameterDescriptor]:
    """Return the descriptors of those parameters that the node knows."""
    request = DescribeParameters.Request(names=names)
    response = call(node, DescribeParameters, f'{node_name}/describe_parameters', request)
    return list(response.descriptors)


def set_parameter(
    node: Any, node_name: str, name: str, value: ParameterValue
) -> SetParametersResult:
    """Set a parameter, or delete it with a value that is not set; return what the node says."""
    request = SetParameters.Request(parameters=[Parameter(name=name, value=value)])
    return call(node, SetParameters, f'{node_name}/set_parameters', request).results[0]


def unknown_parameter_hint(node: Any, node_name: str, name: str) -> str:
    """Return that a node has no such parameter and which one may be meant; '' if it has it."""
    known = list_parameters(node, node_name)
    return '' if name in known else unknown_parameter_text(node_name, name, known)


def unknown_parameter_text(node_name: str, name: str, known: Collection[str]) -> str:
    """Return that a node has no such parameter, and which of its own may be meant."""
    from ros2cli.suggest import did_you_mean

    text = f"The node '{node_name}' has no parameter '{name}'."
    return f'{text} {did_you_mean(name, known)}'.rstrip()
