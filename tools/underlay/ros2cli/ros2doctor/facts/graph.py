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
"""Longer than a second, which is how often they are usually published."""
PERIOD_S = 0.05


@dataclass(frozen=True)
class Endpoint:
    """
    A publisher or subscription.

    :param node: full name of the node that has it
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
    All that is known of the running nodes.

    :param nodes: full names, each as often as there are nodes of that name
    :param elsewhere: names of nodes that run on other machines
    :param domain_id: the domain that was looked at
    :param complaints: what nodes say on the topics `diagnostics` that is not all right
    :param without_clock: names of nodes that take the time from /clock, which nobody publishes
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
    """Look at the graph once, for all checks and reports."""
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
    """Return the nodes that subscribe to /clock, if nobody publishes it."""
    clock = [each for each in endpoints if each.topic == CLOCK]
    return [] if any(each.is_publisher for each in clock) else [each.node for each in clock]


def _spin(node: Any, duration_s: float) -> None:
    """Receive for a while what the topics carry that are listened to."""
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
