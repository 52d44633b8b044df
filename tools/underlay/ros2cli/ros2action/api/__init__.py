# SPDX-License-Identifier: Apache-2.0
"""The actions of the graph."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ros2node.api import actions_of, get_node_names, TopicInfo

__all__ = ['get_action_clients', 'get_action_names_and_types', 'get_action_servers']


def get_action_names_and_types(*, node: Any) -> list[TopicInfo]:
    """Return the names of all actions with their types, sorted."""
    found = actions_of(node.get_service_names_and_types())
    return sorted(TopicInfo(name, types) for name, types in found)


def get_action_clients(node: Any, action: str) -> list[TopicInfo]:
    """Return the full names of the nodes that are clients of an action, with its types."""
    return _nodes_of(node, action, node.get_client_names_and_types_by_node)


def get_action_servers(node: Any, action: str) -> list[TopicInfo]:
    """Return the full names of the nodes that serve an action, with its types."""
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
