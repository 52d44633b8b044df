# SPDX-License-Identifier: Apache-2.0
"""Names in the graph, discovered in a short and bounded time."""

from __future__ import annotations

from typing import NamedTuple

from ros2cli.graph.watch import GraphWatch

SPIN_TIME_S = 0.1


class Names(NamedTuple):
    """The names in the graph: topics and services with their types, and full node names."""

    topics: dict[str, list[str]]
    services: dict[str, list[str]]
    nodes: list[str]


def graph_names() -> Names:
    """Read the names in the graph during a short discovery."""
    from ros2node.api import get_node_names

    with GraphWatch(SPIN_TIME_S) as watch:
        graph = watch.settled()
    nodes = get_node_names(node=graph, include_hidden_nodes=True)
    return Names(
        dict(graph.get_topic_names_and_types()),
        dict(graph.get_service_names_and_types()),
        sorted({name.full_name for name in nodes}),
    )
