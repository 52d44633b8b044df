# SPDX-License-Identifier: Apache-2.0
"""The running nodes, what they publish and subscribe to, and the transforms between frames."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
import sys
import time
from typing import Any

from ros2doctor.facts.transforms import Transform, TransformListener

TRANSFORM_TIME_S = 1.0
PERIOD_S = 0.05


@dataclass(frozen=True)
class Endpoint:
    """
    A publisher or subscription.

    :param node: full name of the node that has it
    :param qos: its quality of service, as rclpy describes it
    """

    topic: str
    node: str
    type_name: str
    is_publisher: bool
    qos: Any


@dataclass(frozen=True)
class Graph:
    """All that is known of the running nodes; `nodes` has a name as often as there are nodes."""

    nodes: tuple[str, ...] = ()
    endpoints: tuple[Endpoint, ...] = ()
    transforms: tuple[Transform, ...] = ()


@lru_cache(maxsize=1)
def read_graph() -> Graph:
    """Look at the graph once, for all checks and reports."""
    from ros2cli.node.direct import DirectNode
    from ros2node.api import get_node_names

    if sys.stderr.isatty():
        print('Looking at the running nodes ...', file=sys.stderr)
    with DirectNode(None) as node:
        listener = TransformListener(node)
        endpoints = tuple(_endpoints(node))
        nodes = get_node_names(node=node, include_hidden_nodes=True)
        listener.listen_to({each.topic: each.type_name for each in endpoints})
        if listener.is_listening:
            _spin(node)
        return Graph(
            tuple(name.full_name for name in nodes), endpoints, tuple(listener.transforms)
        )


def _spin(node: Any) -> None:
    """Receive for a while what the topics of transforms carry."""
    end = time.monotonic() + TRANSFORM_TIME_S
    while time.monotonic() < end:
        node.spin_once(PERIOD_S)


def _endpoints(node: Any) -> Iterator[Endpoint]:
    from ros2cli.node.graph import foreign_publishers, foreign_subscriptions

    for topic, _ in node.get_topic_names_and_types():
        for info in foreign_publishers(node, topic):
            yield _endpoint(topic, info, is_publisher=True)
        for info in foreign_subscriptions(node, topic):
            yield _endpoint(topic, info, is_publisher=False)


def _endpoint(topic: str, info: Any, *, is_publisher: bool) -> Endpoint:
    name = f'{info.node_namespace.rstrip("/")}/{info.node_name}'
    return Endpoint(topic, name, info.topic_type, is_publisher, info.qos_profile)
