# SPDX-License-Identifier: Apache-2.0
"""The nodes of the graph: their names, their interfaces, and waiting for one."""

from __future__ import annotations

from collections import Counter
from typing import Any, NamedTuple, TYPE_CHECKING

from ros2cli.names import closest, is_hidden
from ros2cli.waiting import Patience

if TYPE_CHECKING:
    from ros2cli.graph.graph import Graph
    from ros2cli.graph.watch import GraphWatch

__all__ = [
    'NodeName',
    'TopicInfo',
    'actions_of',
    'find_node',
    'get_node_names',
    'known_nodes',
    'node_sections',
    'nodes_with_service',
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


def find_node(watch: GraphWatch, name: str, timeout_s: float = 0.0) -> str:
    """
    Find a node by its name, and wait for it if it does not exist yet.

    Parameters
    ----------
    watch
        The graph.
    name
        The name that the user has written, with or without the leading slash.
    timeout_s
        How long to wait in s, but at least the spin time of the watch.

    Returns
    -------
    str
        The full name of the node.

    Raises
    ------
    RuntimeError
        The node does not appear in time; the message suggests a similar name.

    """
    full_name = name if name.startswith('/') else f'/{name}'

    def is_known(graph: Graph) -> bool:
        return full_name in known_nodes(graph)

    if not watch.wait_for(is_known, Patience(f"the node '{full_name}'"), timeout_s):
        hint = closest(full_name, known_nodes(watch.graph))
        raise RuntimeError('\n'.join(['Node not found', hint]).rstrip())
    return full_name


def known_nodes(graph: Graph, *, include_hidden_nodes: bool = True) -> list[str]:
    """
    Return the full names of all nodes, each once, sorted.

    Parameters
    ----------
    graph
        The graph.
    include_hidden_nodes
        Whether to return hidden nodes as well.

    """
    names = get_node_names(node=graph, include_hidden_nodes=include_hidden_nodes)
    return sorted({name.full_name for name in names})


def nodes_with_service(
    graph: Graph, suffix: str, service_type: str, *, include_hidden_nodes: bool
) -> list[str]:
    """
    Return the full names of the nodes that offer a service under their own name, sorted.

    Parameters
    ----------
    graph
        The graph.
    suffix
        The name of the service below that of the node, such as `/get_state`.
    service_type
        The type of the service, such as `lifecycle_msgs/srv/GetState`.
    include_hidden_nodes
        Whether to return hidden nodes as well.

    """
    services = dict(graph.get_service_names_and_types())
    return [
        name
        for name in known_nodes(graph, include_hidden_nodes=include_hidden_nodes)
        if service_type in services.get(f'{name}{suffix}', [])
    ]
