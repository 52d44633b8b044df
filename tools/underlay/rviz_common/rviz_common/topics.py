# SPDX-License-Identifier: Apache-2.0
"""What is wrong with a topic: an invalid name, or why no message arrives on it."""

from __future__ import annotations

import re
from typing import Any, TYPE_CHECKING

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.qos import QoSProfile

__all__ = ['full_topic_name', 'is_full_topic_name', 'reason_of_silence']

FULL_NAME = re.compile(r'(/[A-Za-z_][A-Za-z0-9_]*)+')
REASON = re.compile(r'^(?:failed to resolve name: )?(?P<reason>.*?)(?:, at /.*)?$', re.S)
LONGEST_SHOWN = 60


def full_topic_name(node: Node, name: str) -> str:
    """
    Resolve the full name of a topic, with the namespace and remappings of a node.

    Parameters
    ----------
    node
        The node whose namespace and remappings apply.
    name
        The name, as given by a user, a file or a browser.

    Raises
    ------
    ValueError
        The text is not a valid topic name. The exceptions of rclpy for these depend on the fault,
        and their messages have several lines, or the line of a C file.

    """
    try:
        full: str = node.resolve_topic_name(name)
    except Exception as error:  # rclpy has no single exception for invalid names
        shown = name if len(name) <= LONGEST_SHOWN else f'{name[:LONGEST_SHOWN]}...'
        found = REASON.match(str(error))
        reason = found['reason'] if found else error
        raise ValueError(f"'{shown}' is not a valid topic name: {reason}.") from error
    return full


def is_full_topic_name(name: str) -> bool:
    """
    Whether ROS nodes can subscribe to a name: the graph also lists topics of other DDS programs.

    Parameters
    ----------
    name
        The name of the topic, as in the graph.

    """
    return FULL_NAME.fullmatch(name) is not None


def reason_of_silence(node: Node, kind: Any, topic: str, qos: QoSProfile) -> str:
    """
    Return the reason why no message has arrived yet, as the end of a message about that.

    Parameters
    ----------
    node
        The node whose graph is examined.
    kind
        The class of the messages.
    topic
        The topic, as the subscriber names it.
    qos
        The QoS profile of the subscriber.

    """
    try:
        publishers = node.get_publishers_info_by_topic(full_topic_name(node, topic))
    except Exception:  # rclpy has no single exception for invalid names or a lost graph
        return '.'
    if not publishers:
        return ': it has no publisher.'
    reasons = [_reason(each, _type_name(kind), qos) for each in publishers]
    return next((reason for reason in reasons if reason == _WAITS), reasons[0])


_WAITS = ', but it has a publisher: messages may be rare.'


def _reason(publisher: Any, type_name: str, qos: QoSProfile) -> str:
    """Return the reason why no messages arrive from a publisher."""
    from rclpy.qos import DurabilityPolicy, ReliabilityPolicy

    who = f'{publisher.node_namespace.rstrip("/")}/{publisher.node_name}'
    offered = publisher.qos_profile
    if publisher.topic_type != type_name:
        return f': {who} publishes {publisher.topic_type} there, not {type_name}.'
    keeps = DurabilityPolicy.TRANSIENT_LOCAL
    if qos.durability == keeps and offered.durability == DurabilityPolicy.VOLATILE:
        return (
            f': {who} publishes there with incompatible durability: volatile. Set '
            "'Durability Policy' to Volatile."
        )
    if (
        qos.reliability == ReliabilityPolicy.RELIABLE
        and offered.reliability == ReliabilityPolicy.BEST_EFFORT
    ):
        return (
            f': {who} publishes there with incompatible reliability: best effort. Set '
            "'Reliability Policy' to Best Effort."
        )
    if qos.durability == DurabilityPolicy.VOLATILE and offered.durability == keeps:
        return (
            f". {who} keeps its messages for late subscribers: set 'Durability "
            "Policy' to Transient Local to get it."
        )
    return _WAITS


def _type_name(kind: Any) -> str:
    """Return the name of a class of messages, such as `nav_msgs/msg/Path`."""
    package, _, _ = kind.__module__.partition('.')
    return f'{package}/msg/{kind.__name__}'
