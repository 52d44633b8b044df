# SPDX-License-Identifier: Apache-2.0
"""The names in the graph, found in a short and bounded time."""

from __future__ import annotations

from typing import Any, NamedTuple

from ros2cli.completion.memory import domain_id, recall, remember
from ros2cli.node.discovery import wait_until_stable
from ros2cli.node.graph import is_local_only, take_snapshot
from ros2cli.node.neighbours import count_neighbours

SUBJECT = 'graph'
SPIN_TIME_S = 0.25
QUIET_LOOKS = 4


class Names(NamedTuple):
    """What the graph has: topics and services with their types, and the full names of nodes."""

    topics: dict[str, list[str]]
    services: dict[str, list[str]]
    nodes: list[str]


def graph_names() -> Names:
    """Return the names that are remembered, or look at the graph."""
    if is_local_only() and count_neighbours(domain_id()) == 0:
        return Names({}, {}, [])
    remembered = recall(SUBJECT)
    return Names(**remembered) if remembered else _look()


def _look() -> Names:
    from ros2cli.node.direct import DirectNode

    with DirectNode(None, wait=False) as node:
        is_complete = wait_until_stable(
            lambda: take_snapshot(node.node), SPIN_TIME_S, quiet_looks=QUIET_LOOKS
        )
        names = _names_of(node)
    if is_complete:
        remember(SUBJECT, names._asdict())
    return names


def _names_of(node: Any) -> Names:
    from ros2node.api import get_node_names
    from ros2topic.api import get_topic_names_and_types

    nodes = get_node_names(node=node, include_hidden_nodes=True)
    return Names(
        dict(get_topic_names_and_types(node=node, include_hidden_topics=True)),
        dict(sorted(node.get_service_names_and_types())),
        sorted({name.full_name for name in nodes}),
    )
