# SPDX-License-Identifier: Apache-2.0
"""The running nodes, what they publish and subscribe to, and the transforms between frames."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache
import sys
import time
from typing import Any

from ros2cli.graph.graph import Graph as ObservedGraph
from ros2doctor.facts.clock import nodes_on_clock
from ros2doctor.facts.clock import TOPIC as CLOCK
from ros2doctor.facts.diagnostics import Complaint, DiagnosticsListener
from ros2doctor.facts.transforms import Transform, TransformListener

TRANSFORM_TIME_S = 1.0
DIAGNOSTICS_TIME_S = 1.5
"""Longer than a second, their usual publication period."""
PERIOD_S = 0.05


@dataclass(frozen=True)
class Endpoint:
    """
    A publisher or subscription.

    :param node: full name of its node
    :param qos: its quality of service, as rclpy describes it
    :param is_elsewhere: whether it is on another machine
    """

    topic: str
    node: str
    type_name: str
    is_publisher: bool
    qos: Any
    is_elsewhere: bool = False


@dataclass(frozen=True)
class Graph:
    """
    Facts about the running nodes.

    :param nodes: full names, repeated for each node of that name
    :param elsewhere: names of nodes that run on other machines
    :param domain_id: the ROS domain ID
    :param complaints: statuses on the `diagnostics` topics that are not OK
    :param without_clock: names of nodes that use /clock although it is not published
    """

    nodes: tuple[str, ...] = ()
    endpoints: tuple[Endpoint, ...] = ()
    transforms: tuple[Transform, ...] = ()
    elsewhere: tuple[str, ...] = ()
    domain_id: int = 0
    without_clock: tuple[str, ...] = ()
    complaints: tuple[Complaint, ...] = ()


@lru_cache(maxsize=1)
def read_graph() -> Graph:
    """Read the graph once, for all checks and reports."""
    from ros2cli.node.direct import DirectNode
    from ros2node.api import get_node_names

    if sys.stderr.isatty():
        print('Looking at the running nodes ...', file=sys.stderr)
    with DirectNode(None) as node:
        listener = TransformListener(node)
        known = node.graph
        endpoints = tuple(_endpoints(known))
        nodes = get_node_names(node=known, include_hidden_nodes=True)
        diagnostics = DiagnosticsListener(node)
        types = {each.topic: each.type_name for each in endpoints if each.is_publisher}
        listener.listen_to(types)
        diagnostics.listen_to(types)
        if diagnostics.is_listening:
            _spin(node, DIAGNOSTICS_TIME_S)
        elif listener.is_listening:
            _spin(node, TRANSFORM_TIME_S)
        return Graph(
            tuple(name.full_name for name in nodes),
            endpoints,
            tuple(listener.transforms),
            tuple(sorted({each.node for each in endpoints if each.is_elsewhere})),
            node.watch.domain_id,
            nodes_on_clock(node, _waiting_for_clock(endpoints)),
            tuple(diagnostics.complaints),
        )


def _waiting_for_clock(endpoints: Iterable[Endpoint]) -> list[str]:
    """Return the nodes that subscribe to /clock, if it is not published."""
    clock = [each for each in endpoints if each.topic == CLOCK]
    return [] if any(each.is_publisher for each in clock) else [each.node for each in clock]


def _spin(node: Any, duration_s: float) -> None:
    """Spin for a while to receive from the subscribed topics."""
    end = time.monotonic() + duration_s
    while time.monotonic() < end:
        node.spin_once(PERIOD_S)


def _endpoints(known: ObservedGraph) -> Iterator[Endpoint]:
    for topic, _ in known.get_topic_names_and_types():
        for info in known.get_publishers_info_by_topic(topic):
            yield _endpoint(known, topic, info, is_publisher=True)
        for info in known.get_subscriptions_info_by_topic(topic):
            yield _endpoint(known, topic, info, is_publisher=False)


def _endpoint(known: ObservedGraph, topic: str, info: Any, *, is_publisher: bool) -> Endpoint:
    return Endpoint(
        topic,
        f'{info.node_namespace.rstrip("/")}/{info.node_name}',
        info.topic_type,
        is_publisher,
        info.qos_profile,
        known.is_elsewhere(info),
    )
