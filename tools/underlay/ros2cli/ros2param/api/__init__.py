# SPDX-License-Identifier: Apache-2.0
"""The parameters of a node, accessed through its services."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Any

from rcl_interfaces.msg import Parameter, ParameterDescriptor, ParameterValue, SetParametersResult
from rcl_interfaces.srv import DescribeParameters, GetParameters, ListParameters, SetParameters
from ros2cli.waiting import call

__all__ = [
    'LIST_SERVICE',
    'LIST_TYPE',
    'describe_parameters',
    'get_parameters',
    'list_parameters',
    'refusal_hint',
    'set_parameter',
    'unknown_parameter_hint',
    'unknown_parameter_text',
]

LIST_SERVICE = '/list_parameters'
LIST_TYPE = 'rcl_interfaces/srv/ListParameters'


def list_parameters(
    node: Any, node_name: str, prefixes: Sequence[str] = (), timeout_s: float = float('inf')
) -> list[str]:
    """
    List the names of a node's parameters, sorted.

    Parameters
    ----------
    node
        The `DirectNode` that calls.
    node_name
        Full name of the node that has the parameters.
    prefixes
        Only names with one of these prefixes, as `a` for `a.b`; all names if it is empty.
    timeout_s
        The timeout for the response once the service is connected, in s.

    Raises
    ------
    RuntimeError
        The service does not connect, disappears or does not respond in time.

    """
    request = ListParameters.Request(prefixes=prefixes)
    response = call(node, ListParameters, f'{node_name}{LIST_SERVICE}', request, timeout_s)
    return sorted(response.result.names)


def get_parameters(node: Any, node_name: str, names: list[str]) -> list[ParameterValue]:
    """
    Get the values of parameters.

    A node may return no values at all because one of the parameters is not declared; then each is
    requested separately.

    Parameters
    ----------
    node
        The `DirectNode` that calls.
    node_name
        Full name of the node that has the parameters.
    names
        The parameters to get.

    Returns
    -------
    list of ParameterValue
        The values in the order of `names`; an unknown parameter has the type `PARAMETER_NOT_SET`.

    Raises
    ------
    RuntimeError
        The service does not connect, or disappears before it responds.

    """
    request = GetParameters.Request(names=names)
    values = list(call(node, GetParameters, f'{node_name}/get_parameters', request).values)
    if len(values) == len(names):
        return values
    if len(names) == 1:
        return [ParameterValue()]
    return [value for name in names for value in get_parameters(node, node_name, [name])]


def describe_parameters(node: Any, node_name: str, names: list[str]) -> list[ParameterDescriptor]:
    """
    Get the descriptors of parameters: type, description and constraints.

    Parameters
    ----------
    node
        The `DirectNode` that calls.
    node_name
        Full name of the node that has the parameters.
    names
        Declared parameters, as `list_parameters` lists them.

    Returns
    -------
    list of ParameterDescriptor
        The descriptors, as the node returns them.

    Raises
    ------
    RuntimeError
        The service does not connect, or disappears before it responds.

    """
    request = DescribeParameters.Request(names=names)
    response = call(node, DescribeParameters, f'{node_name}/describe_parameters', request)
    return list(response.descriptors)


def set_parameter(
    node: Any, node_name: str, name: str, value: ParameterValue
) -> SetParametersResult:
    """
    Set or delete a parameter of a node.

    Parameters
    ----------
    node
        The `DirectNode` that calls.
    node_name
        Full name of the node that has the parameter.
    name
        The parameter.
    value
        Its new value; one of the type `PARAMETER_NOT_SET` deletes the parameter.

    Returns
    -------
    SetParametersResult
        Whether the node accepted the value, and its reason.

    Raises
    ------
    RuntimeError
        The service does not connect, or disappears before it responds.

    """
    request = SetParameters.Request(parameters=[Parameter(name=name, value=value)])
    return call(node, SetParameters, f'{node_name}/set_parameters', request).results[0]


def unknown_parameter_hint(node: Any, node_name: str, name: str) -> str:
    """
    Explain that a node has no such parameter, and suggest the closest name.

    Parameters
    ----------
    node
        The `DirectNode` that asks for the names.
    node_name
        Full name of the node.
    name
        The parameter as the user wrote it.

    Returns
    -------
    str
        The message, or '' if the node has the parameter.

    """
    known = list_parameters(node, node_name)
    return '' if name in known else unknown_parameter_text(node_name, name, known)


def unknown_parameter_text(node_name: str, name: str, known: Collection[str]) -> str:
    """
    Format the message for an unknown parameter, with a suggestion if a known name is close.

    Parameters
    ----------
    node_name
        Full name of the node.
    name
        The parameter as the user wrote it.
    known
        The names of the node's parameters.

    """
    from ros_environment.suggestions import did_you_mean

    text = f"The node '{node_name}' has no parameter '{name}'."
    return f'{text} {did_you_mean(name, known)}'.rstrip()


def refusal_hint(node: Any, node_name: str, name: str, value: ParameterValue, reason: str) -> str:
    """
    Explain why a node may have rejected a parameter value: unknown name or wrong type.

    Parameters
    ----------
    node
        The `DirectNode` that calls.
    node_name
        Full name of the node.
    name, value
        The parameter, and the value that was rejected.
    reason
        The node's own reason; types are only compared if it contains the word "type".

    Returns
    -------
    str
        The hint, with the way to write the value if that helps, or ''.

    """
    from ros2param.api.values import to_plain_value, type_name, TYPES

    current = get_parameters(node, node_name, [name])[0]
    if current.type not in TYPES:
        return unknown_parameter_hint(node, node_name, name)
    if current.type == value.type or 'type' not in reason:
        return ''
    wanted, given = type_name(current.type), type_name(value.type)
    plain = to_plain_value(value)
    text = f"'{name}' is of the type {wanted}, but {plain!r} is {given}."
    if (wanted, given) == ('double', 'integer'):
        return f'{text} Write {float(plain)}.'
    if (wanted, given) == ('double array', 'integer array'):
        return f'{text} Write {[float(item) for item in plain]}.'
    if wanted == 'string':
        return f"{text} Quotes make it a string: '...' in a file, \"'...'\" in a terminal."
    return text
