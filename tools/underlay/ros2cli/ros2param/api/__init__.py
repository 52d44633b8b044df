# SPDX-License-Identifier: Apache-2.0
"""The parameters of a node, accessed through its services: how it is named, found and asked."""

from __future__ import annotations

import argparse
from collections.abc import Collection, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, TYPE_CHECKING

from rcl_interfaces.msg import Parameter, ParameterDescriptor, ParameterValue, SetParametersResult
from rcl_interfaces.srv import DescribeParameters, GetParameters, ListParameters, SetParameters
from ros2cli.arguments import add_hidden_nodes_argument, add_strategy_arguments, positive_number
from ros2cli.waiting import call, Patience

if TYPE_CHECKING:
    from ros2cli.graph.graph import Graph

__all__ = [
    'LIST_SERVICE',
    'LIST_TYPE',
    'add_node_name_argument',
    'add_param_arguments',
    'add_parameter_name_argument',
    'describe_parameters',
    'get_parameters',
    'list_parameters',
    'refusal_hint',
    'remote_node',
    'set_parameter',
    'unknown_parameter_hint',
    'unknown_parameter_text',
]

LIST_SERVICE = '/list_parameters'
LIST_TYPE = 'rcl_interfaces/srv/ListParameters'
DEFAULT_TIMEOUT_S = 1.0


def add_param_arguments(parser: argparse.ArgumentParser) -> None:
    """
    Add the options for discovery, hidden nodes and the timeout.

    Parameters
    ----------
    parser
        The parser of the verb.

    """
    add_strategy_arguments(parser)
    add_hidden_nodes_argument(parser)
    parser.add_argument(
        '--timeout',
        metavar='N',
        type=positive_number,
        default=DEFAULT_TIMEOUT_S,
        help='Wait for N seconds until node becomes available (default: %(default)s)',
    )


def add_node_name_argument(parser: argparse.ArgumentParser, *, optional: bool = False) -> None:
    """
    Add the positional argument `node_name`.

    Parameters
    ----------
    parser
        The parser of the verb.
    optional
        Whether it may be left out; `node_name` is None then.

    """
    parser.add_argument('node_name', nargs='?' if optional else None, help='Name of the ROS node')


def add_parameter_name_argument(parser: argparse.ArgumentParser) -> None:
    """
    Add the positional argument `parameter_name`.

    Parameters
    ----------
    parser
        The parser of the verb.

    """
    parser.add_argument('parameter_name', help='Name of the parameter')


@contextmanager
def remote_node(args: argparse.Namespace) -> Iterator[tuple[Any, str]]:
    """
    Create a node for this command and find the one whose parameters it accesses.

    Parameters
    ----------
    args : argparse.Namespace
        The parsed command line, with `node_name` and `timeout` (s).

    Yields
    ------
    tuple of DirectNode and str
        The node of this command, and the full name of the other one.

    Raises
    ------
    RuntimeError
        The other node does not appear in time, or has no parameter services.

    """
    from ros2cli.node.direct import DirectNode
    from ros2node.api import find_node

    with DirectNode(args) as node:
        name = find_node(node.watch, args.node_name, args.timeout)
        _require_services(node, name, args.timeout)
        yield node, name


def _require_services(node: Any, name: str, timeout_s: float) -> None:
    def has_services(graph: Graph) -> bool:
        return bool(graph.count_services(f'{name}{LIST_SERVICE}'))

    patience = Patience(f"the parameter services of '{name}'")
    if not node.watch.wait_for(has_services, patience, timeout_s):
        raise RuntimeError(
            f"The node '{name}' has no parameter services: it was started with "
            'start_parameter_services=False'
        )


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
