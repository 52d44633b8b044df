# SPDX-License-Identifier: Apache-2.0
"""Actions in the graph."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ros2cli.names import closest
from ros2node.api import actions_of, get_node_names, TopicInfo

__all__ = [
    'action_hint',
    'get_action_clients',
    'get_action_names_and_types',
    'get_action_servers',
]


def get_action_names_and_types(*, node: Any) -> list[TopicInfo]:
    """
    Return the names and types of all actions in the graph, sorted by name.

    Parameters
    ----------
    node
        The graph, or a node with its methods: whatever has `get_service_names_and_types`.

    """
    found = actions_of(node.get_service_names_and_types())
    return sorted(TopicInfo(name, types) for name, types in found)


def get_action_clients(node: Any, action: str) -> list[TopicInfo]:
    """
    Find the nodes that have a client of an action.

    Parameters
    ----------
    node
        The graph, or a node with its methods.
    action
        The full name of the action, such as `/fibonacci`.

    Returns
    -------
    list of TopicInfo
        The full name of each node, hidden ones included, with the types by which it uses the
        action.

    """
    return _nodes_of(node, action, node.get_client_names_and_types_by_node)


def get_action_servers(node: Any, action: str) -> list[TopicInfo]:
    """
    Find the nodes that have a server of an action.

    Parameters
    ----------
    node
        The graph, or a node with its methods.
    action
        The full name of the action, such as `/fibonacci`.

    Returns
    -------
    list of TopicInfo
        The full name of each node, hidden ones included, with the types by which it serves the
        action.

    """
    return _nodes_of(node, action, node.get_service_names_and_types_by_node)


def _nodes_of(
    node: Any, action: str, services_by_node: Callable[[str, str], list[tuple[str, list[str]]]]
) -> list[TopicInfo]:
    return [
        TopicInfo(remote.full_name, types)
        for remote in get_node_names(node=node, include_hidden_nodes=True)
        for name, types in actions_of(services_by_node(remote.name, remote.namespace))
        if name == action
    ]


def action_hint(node: Any, action: str, type_name: str) -> str:
    """
    Return a hint to an action of another type or name that may be meant, or ''.

    Parameters
    ----------
    node
        The graph, or a node with its methods.
    action
        The full name of the action that is looked for.
    type_name
        Its type, such as `tf2_msgs/action/LookupTransform`.

    """
    servers = get_action_servers(node, action)
    types = [each for server in servers for each in server.types if each != type_name]
    if types:
        return f"'{action}' has the type '{types[0]}', not '{type_name}'."
    names = [name for name, _ in get_action_names_and_types(node=node)]
    return closest(action, [name for name in names if name != action])
