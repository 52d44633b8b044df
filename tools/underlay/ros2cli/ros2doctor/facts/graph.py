# SPDX-License-Identifier: Apache-2.0
"""The running nodes, what they publish and subscribe to, and the transforms between frames."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache
import sys
import time
from typing import Any

from ros2doctor.facts.transforms import Transform, TransformListener

TRANSFORM_TIME_S = 1.0
PERIOD_S = 0.05
TOPIC_OF_ALL_NODES = '/parameter_events'
HOST_BYTES = slice(0, 4)  # of a GUID of Fast DDS: the vendor, then the machine


@dataclass(frozen=True)
class Endpoint:
    """
    A publisher or subscription.

    :param node: full name of the node that has it
    :param qos: its quality of service, as rclpy describes it
    :param host: what the middleware knows the machine by
    """

    topic: str
    node: str
    type_name: str
    is_publisher: bool
    qos: Any
    host: bytes = b''


@dataclass(frozen=True)
class Graph:
    """
    All that is known of the running nodes.

    :param nodes: full names, each as often as there are nodes of that name
    :param elsewhere: names of nodes that run on other machines
    :param domain_id: the domain that was looked at
    """

    nodes: tuple[str, ...] = ()
    endpoints: tuple[Endpoint, ...] = ()
    transforms: tuple[Transform, ...] = ()
    elsewhere: tuple[str, ...] = ()
    domain_id: int = 0


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
            tuple(name.full_name for name in nodes),
            endpoints,
            tuple(listener.transforms),
            _elsewhere(endpoints, _own_host(node)),
            node.context.get_domain_id(),
        )


def _own_host(node: Any) -> bytes | None:
    """Return what the middleware knows this machine by, from a publisher of the node itself."""
    for info in node.get_publishers_info_by_topic(TOPIC_OF_ALL_NODES):
        if info.node_name == node.get_name():
            return _host(info)
    return None


def _elsewhere(endpoints: Iterable[Endpoint], own_host: bytes | None) -> tuple[str, ...]:
    """Return the names of nodes on other machines, sorted."""
    if own_host is None:
        return ()
    return tuple(sorted({each.node for each in endpoints if each.host != own_host}))


def _host(info: Any) -> bytes:
    return bytes(info.endpoint_gid[HOST_BYTES])


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
    return Endpoint(topic, name, info.topic_type, is_publisher, info.qos_profile, _host(info))
