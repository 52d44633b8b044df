# SPDX-License-Identifier: Apache-2.0
"""The nodes of the graph and their interfaces."""

from __future__ import annotations

from collections import Counter
from typing import Any, NamedTuple

from ros2cli.names import is_hidden

__all__ = [
    'NodeName',
    'TopicInfo',
    'actions_of',
    'get_node_names',
    'node_sections',
    'shared_names',
]


class NodeName(NamedTuple):
    """The name of a node in its parts and as a whole."""

    name: str
    namespace: str
    full_name: str


class TopicInfo(NamedTuple):
    """The name of a topic, service or action and its types."""

    name: str
    types: list[str]


def get_node_names(*, node: Any, include_hidden_nodes: bool = False) -> list[NodeName]:
    """
    List the nodes of the graph, sorted by full name.

    Parameters
    ----------
    node
        A `Graph`, which excludes the calling node, or any other object with
        `get_node_names_and_namespaces`.
    include_hidden_nodes
        Whether to include nodes with a leading underscore in the name or a part of the namespace.

    Returns
    -------
    list of NodeName
        One entry per node; nodes that share a name are listed as often as they exist.

    """
    names = (
        NodeName(name, namespace, f'{namespace.rstrip("/")}/{name}')
        for name, namespace in node.get_node_names_and_namespaces()
    )
    return sorted(
        (name for name in names if include_hidden_nodes or not is_hidden(name.full_name)),
        key=lambda name: name.full_name,
    )


def shared_names(names: list[NodeName]) -> list[str]:
    """
    Find the full names that are shared by several nodes.

    Parameters
    ----------
    names
        The nodes, as `get_node_names` lists them.

    Returns
    -------
    list of str
        Each of these full names once, sorted.

    """
    counts = Counter(name.full_name for name in names)
    return sorted(name for name, count in counts.items() if count > 1)


def node_sections(
    node: Any,
    remote: NodeName,
    include_hidden: bool = False,
) -> list[tuple[str, list[TopicInfo]]]:
    """
    Collect the publishers, subscribers, services and actions of a node for `ros2 node info`.

    Parameters
    ----------
    node
        The `Graph`.
    remote
        The node to describe.
    include_hidden
        Whether to include topics, services and actions with a part that starts with an underscore.

    Returns
    -------
    list of tuple of str and list of TopicInfo
        The headings in the order of printing, each with its entries, sorted by name.

    """
    of_node = (remote.name, remote.namespace)
    subscribers = node.get_subscriber_names_and_types_by_node(*of_node)
    publishers = node.get_publisher_names_and_types_by_node(*of_node)
    servers = node.get_service_names_and_types_by_node(*of_node)
    clients = node.get_client_names_and_types_by_node(*of_node)
    sections = [
        ('Subscribers', subscribers),
        ('Publishers', publishers),
        ('Service Servers', servers),
        ('Service Clients', clients),
        ('Action Servers', actions_of(servers)),
        ('Action Clients', actions_of(clients)),
    ]
    return [(title, _visible(found, include_hidden)) for title, found in sections]


def _visible(found: list[tuple[str, list[str]]], include_hidden: bool) -> list[TopicInfo]:
    infos = (TopicInfo(name, types) for name, types in sorted(found))
    return [info for info in infos if include_hidden or '/_' not in info.name]


def actions_of(services: list[tuple[str, list[str]]]) -> list[tuple[str, list[str]]]:
    """
    Derive actions from the hidden services that each action consists of.

    Parameters
    ----------
    services
        Names and types of services, as `Graph.get_service_names_and_types` returns them.

    Returns
    -------
    list of tuple of str and list of str
        The name of each action with its types, such as `tf2_msgs/action/LookupTransform`.

    """
    suffix = '/_action/send_goal'
    return [
        (name[: -len(suffix)], [text.replace('_SendGoal', '') for text in types])
        for name, types in services
        if name.endswith(suffix)
    ]
