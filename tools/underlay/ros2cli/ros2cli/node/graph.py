# SPDX-License-Identifier: Apache-2.0
"""Snapshots of the graph, and what in it belongs to the command itself."""

from __future__ import annotations

import os
from typing import Any

from ros2cli.node.discovery import Snapshot
from ros2cli.node.neighbours import count_neighbours

UNKNOWN_NODE_NAME = '_NODE_NAME_UNKNOWN_'
TOPIC_OF_ALL_NODES = '/parameter_events'
PARTICIPANT_BYTES = 12


def take_snapshot(node: Any) -> Snapshot:
    """Return the names of all nodes, topics and services that a node knows of now."""
    endpoints = foreign_publishers(node, TOPIC_OF_ALL_NODES)
    content = (
        tuple(sorted(node.get_node_names_and_namespaces())),
        tuple(sorted(name for name, _ in node.get_topic_names_and_types())),
        tuple(sorted(name for name, _ in node.get_service_names_and_types())),
        len(endpoints),
    )
    return Snapshot(content, _is_complete(node, endpoints))


def foreign_topics(node: Any, names: list[str]) -> list[str]:
    """Return the topics which are not there just because of the node that asks."""
    return [
        name
        for name in names
        if name != TOPIC_OF_ALL_NODES
        or foreign_publishers(node, name)
        or foreign_subscriptions(node, name)
    ]


def foreign_publishers(node: Any, topic: str) -> list[Any]:
    """Return the endpoints that publish to a topic, without those of the node that asks."""
    return _without_own(node, node.get_publishers_info_by_topic(topic))


def foreign_subscriptions(node: Any, topic: str) -> list[Any]:
    """Return the endpoints that subscribe to a topic, without those of the node that asks."""
    return _without_own(node, node.get_subscriptions_info_by_topic(topic))


def _without_own(node: Any, endpoints: list[Any]) -> list[Any]:
    return [info for info in endpoints if info.node_name != node.get_name()]


def _is_complete(node: Any, endpoints: list[Any]) -> bool | None:
    """Compare the participants whose nodes are known with those that exist on this machine."""
    if any(info.node_name == UNKNOWN_NODE_NAME for info in endpoints):
        return False
    existing = count_neighbours(node.context.get_domain_id())
    seen = len({bytes(info.endpoint_gid[:PARTICIPANT_BYTES]) for info in endpoints})
    if existing is not None and seen < existing:
        return False
    return None if existing is None or not is_local_only() else True


def is_local_only() -> bool:
    """Tell if discovery is confined to this machine, where all participants are countable."""
    return os.environ.get('ROS_AUTOMATIC_DISCOVERY_RANGE', '').upper() == 'LOCALHOST' and (
        not os.environ.get('ROS_STATIC_PEERS')
    )
