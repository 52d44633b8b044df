# SPDX-License-Identifier: Apache-2.0
"""Find nodes by the names that users write, and by the services that they offer."""

from __future__ import annotations

from ros2cli.graph.graph import Graph
from ros2cli.graph.watch import GraphWatch
from ros2cli.names import closest
from ros2cli.patience import Patience
from ros2node.api import get_node_names


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
