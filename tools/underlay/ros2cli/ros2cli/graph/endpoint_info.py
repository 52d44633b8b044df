# SPDX-License-Identifier: Apache-2.0
"""Conversion of endpoints to the TopicEndpointInfo of rclpy; only this module needs rclpy."""

from __future__ import annotations

import re

from rclpy.duration import Duration
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    LivelinessPolicy,
    QoSProfile,
    ReliabilityPolicy,
)
from rclpy.topic_endpoint_info import TopicEndpointInfo, TopicEndpointTypeEnum
from rclpy.type_hash import TypeHash
from ros2cli.names import ros_type
from ros2cli.rtps import entities as dds

UNKNOWN_NODE = dds.NodeEntities(
    '_NODE_NAMESPACE_UNKNOWN_', '_NODE_NAME_UNKNOWN_', frozenset(), frozenset()
)
RELIABILITIES = {
    dds.RELIABLE: ReliabilityPolicy.RELIABLE,
    dds.BEST_EFFORT: ReliabilityPolicy.BEST_EFFORT,
}
DURABILITIES = {
    dds.TRANSIENT_LOCAL: DurabilityPolicy.TRANSIENT_LOCAL,
    dds.VOLATILE: DurabilityPolicy.VOLATILE,
}
LIVELINESSES = {
    dds.AUTOMATIC: LivelinessPolicy.AUTOMATIC,
    dds.MANUAL_BY_TOPIC: LivelinessPolicy.MANUAL_BY_TOPIC,
}
TYPE_HASH = re.compile(r'RIHS(\d{2})_([0-9a-f]{64})')


def endpoint_info(endpoint: dds.Endpoint, node: dds.NodeEntities | None) -> TopicEndpointInfo:
    """
    Convert an endpoint to the TopicEndpointInfo of rclpy.

    Parameters
    ----------
    endpoint
        The reader or writer, as discovery describes it.
    node
        The node that it belongs to; None if that is unknown.

    """
    owner = node or UNKNOWN_NODE
    role = TopicEndpointTypeEnum
    return TopicEndpointInfo(
        node_name=owner.name,
        node_namespace=owner.namespace,
        topic_type=ros_type(endpoint.type_name),
        topic_type_hash=_type_hash(endpoint.type_hash),
        endpoint_type=role.PUBLISHER if endpoint.is_writer else role.SUBSCRIPTION,
        endpoint_gid=list(endpoint.guid),
        qos_profile=_profile(endpoint.qos),
    )


def _profile(qos: dds.Qos) -> QoSProfile:
    """Build a QoSProfile; discovery does not transmit the history policy."""
    return QoSProfile(
        history=HistoryPolicy.UNKNOWN,
        depth=0,
        reliability=RELIABILITIES.get(qos.reliability, ReliabilityPolicy.UNKNOWN),
        durability=DURABILITIES.get(qos.durability, DurabilityPolicy.UNKNOWN),
        lifespan=Duration(nanoseconds=qos.lifespan_ns),
        deadline=Duration(nanoseconds=qos.deadline_ns),
        liveliness=LIVELINESSES.get(qos.liveliness, LivelinessPolicy.UNKNOWN),
        liveliness_lease_duration=Duration(nanoseconds=qos.lease_ns),
    )


def _type_hash(text: str) -> TypeHash:
    match = TYPE_HASH.fullmatch(text)
    return TypeHash(int(match[1]), bytes.fromhex(match[2])) if match else TypeHash()
