# SPDX-License-Identifier: Apache-2.0
"""Component containers, queried through their services."""

from __future__ import annotations

import argparse
from typing import Any, NamedTuple

from rcl_interfaces.msg import Parameter
from ros2cli.graph.graph import Graph
from ros2cli.graph.watch import GraphWatch
from ros2cli.names import closest
from ros2cli.waiting import call
from ros2node.api import nodes_with_service
from ros2param.api.values import parse_value

__all__ = [
    'Component',
    'find_container',
    'get_components',
    'get_containers',
    'load_component',
    'unload_component',
]

SERVICE = '/_container'
LIST_TYPE = 'composition_interfaces/srv/ListNodes'


class Component(NamedTuple):
    """A component in a container."""

    uid: int
    name: str


def get_containers(graph: Graph) -> list[str]:
    """
    Return the full names of all component containers, sorted.

    Parameters
    ----------
    graph
        The graph; a container is a node that offers the service `_container/list_nodes`.

    """
    return nodes_with_service(graph, f'{SERVICE}/list_nodes', LIST_TYPE, include_hidden_nodes=True)


def find_container(watch: GraphWatch, name: str) -> str:
    """
    Find a component container by its name.

    Parameters
    ----------
    watch
        The graph; the container is waited for during the spin time if it is not in it yet.
    name
        The name as written by the user, with or without the leading slash.

    Returns
    -------
    str
        The full name of the container.

    Raises
    ------
    RuntimeError
        There is no such container; the message suggests a similar name.

    """
    full_name = name if name.startswith('/') else f'/{name}'
    known = get_containers(watch.settled_with(lambda graph: full_name in get_containers(graph)))
    if full_name not in known:
        text = f"Unable to find container node '{name}'"
        raise RuntimeError('\n'.join([text, closest(full_name, known)]).rstrip())
    return full_name


def get_components(node: Any, container: str, timeout_s: float) -> list[Component]:
    """
    List the components in a container, through its service `_container/list_nodes`.

    Parameters
    ----------
    node
        The node that calls the service.
    container
        The full name of the container.
    timeout_s
        The timeout for the response, in s.

    Returns
    -------
    list of Component
        In the order of the response.

    Raises
    ------
    RuntimeError
        The service does not connect or does not answer in time, or its types are not installed.

    """
    service = container_services().ListNodes
    response = call(
        node, service, f'{container}{SERVICE}/list_nodes', service.Request(), timeout_s
    )
    return [
        Component(uid, name) for uid, name in zip(response.unique_ids, response.full_node_names)
    ]


def load_component(node: Any, container: str, args: argparse.Namespace) -> Component:
    """
    Load a component into a container, through its service `_container/load_node`.

    Parameters
    ----------
    node
        The node that calls the service.
    container
        The full name of the container.
    args : argparse.Namespace
        The options of `add_load_arguments`: what to load, with which name and parameters.

    Returns
    -------
    Component
        The unique ID assigned by the container, and the full node name.

    Raises
    ------
    RuntimeError
        The container rejects the request, disappears, or does not connect.

    """
    service = container_services().LoadNode
    request = service.Request(
        package_name=args.package_name,
        plugin_name=args.plugin_name,
        node_name=args.node_name or '',
        node_namespace=args.node_namespace or '',
        log_level=args.log_level,
        remap_rules=args.remap_rule,
        parameters=[_parameter(text) for text in args.parameter],
        extra_arguments=[_parameter(text) for text in args.extra_argument],
    )
    response = call(node, service, f'{container}{SERVICE}/load_node', request)
    if not response.success:
        raise RuntimeError(f'Failed to load component: {_capitalized(response.error_message)}')
    return Component(response.unique_id, response.full_node_name)


def unload_component(node: Any, container: str, uid: int) -> str:
    """
    Unload a component from a container, through its service `_container/unload_node`.

    Parameters
    ----------
    node
        The node that calls the service.
    container
        The full name of the container.
    uid
        The unique ID of the component in the container.

    Returns
    -------
    str
        '' if the component is unloaded, else the reason that the container gives.

    Raises
    ------
    RuntimeError
        The container disappears or does not connect.

    """
    service = container_services().UnloadNode
    request = service.Request(unique_id=uid)
    response = call(node, service, f'{container}{SERVICE}/unload_node', request)
    return '' if response.success else response.error_message or 'the container gave no reason'


def _capitalized(reason: str) -> str:
    return reason[:1].upper() + reason[1:] or 'the container gave no reason'


def _parameter(text: str) -> Parameter:
    name, _, value = text.partition(':=')
    return Parameter(name=name, value=parse_value(value))


def container_services() -> Any:
    """Return the module with the service classes; raise RuntimeError if it is not installed."""
    try:
        from composition_interfaces import srv
    except ImportError as error:
        raise RuntimeError(
            "The package 'composition_interfaces' cannot be imported, so no container can be "
            f'queried: {error}. Is it built, and the environment sourced?'
        ) from error
    return srv
