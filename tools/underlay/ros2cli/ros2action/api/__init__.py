# SPDX-License-Identifier: Apache-2.0
"""The actions of the graph."""

from __future__ import annotations

from typing import Any

from rclpy.action.graph import (
    get_action_client_names_and_types_by_node,
    get_action_server_names_and_types_by_node,
)
from rclpy.action.graph import get_action_names_and_types as _get_action_names_and_types
from ros2node.api import get_node_names, TopicInfo

__all__ = ['get_action_clients', 'get_action_names_and_types', 'get_action_servers']


def get_action_names_and_types(*, node: Any) -> list[TopicInfo]:
    """Return the names of all actions with their types, sorted."""
    return sorted(TopicInfo(name, types) for name, types in _names_and_types(node))


def get_action_clients(node: Any, action: str) -> list[TopicInfo]:
    """Return the full names of the nodes that are clients of an action, with its types."""
    return _nodes_of(node, action, get_action_client_names_and_types_by_node)


def get_action_servers(node: Any, action: str) -> list[TopicInfo]:
    """Return the full names of the nodes that serve an action, with its types."""
    return _nodes_of(node, action, get_action_server_names_and_types_by_node)


def _names_and_types(node: Any) -> list[tuple[str, list[str]]]:
    found: list[tuple[str, list[str]]] = _get_action_names_and_types(node.node)
    return found


def _nodes_of(node: Any, action: str, actions_by_node: Any) -> list[TopicInfo]:
    return [
        TopicInfo(remote.full_name, types)
        for remote in get_node_names(node=node, include_hidden_nodes=True)
        for name, types in actions_by_node(node.node, remote.name, remote.namespace)
        if name == action
    ]
