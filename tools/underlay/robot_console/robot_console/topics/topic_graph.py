# SPDX-License-Identifier: Apache-2.0
"""Publishers and subscribers of topics, and their QoS compatibility."""

from __future__ import annotations

from typing import Any, TYPE_CHECKING

from rclpy.qos import qos_check_compatible, QoSCompatibility
from rviz_common.topic_names import is_full_topic_name

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['Row', 'ends_of', 'mismatches', 'rows_of', 'types_of']

Row = tuple[str, str, int, int]
SHORT = {
    'RELIABLE': 'reliable',
    'BEST_EFFORT': 'best effort',
    'TRANSIENT_LOCAL': 'transient local',
    'VOLATILE': 'volatile',
}
MOST = 5


def types_of(node: Node) -> dict[str, list[str]]:
    """
    List the topics that nodes can subscribe to, with their types.

    Parameters
    ----------
    node
        The node that is queried for the graph.

    """
    return {
        name: list(types)
        for name, types in node.get_topic_names_and_types()
        if is_full_topic_name(name)
    }


def rows_of(node: Node, types: dict[str, list[str]]) -> list[Row]:
    """
    Build the rows of the topic list, sorted by name.

    Parameters
    ----------
    node
        The node that is queried for the graph.
    types
        The types of the topics, by name.

    Returns
    -------
    list of Row
        Name, types, number of publishers and number of subscribers of each topic.

    """
    return [
        (name, ', '.join(kinds), node.count_publishers(name), node.count_subscribers(name))
        for name, kinds in sorted(types.items())
    ]


def ends_of(node: Node, topic: str) -> dict[str, list[tuple[str, str]]]:
    """
    List the publishers and subscribers of a topic.

    Parameters
    ----------
    node
        The node that is queried for the graph.
    topic
        The fully qualified name of the topic.

    Returns
    -------
    dict
        `publishers` and `subscribers`, each as pairs of node name and QoS.

    """
    return {
        'publishers': _named(node.get_publishers_info_by_topic(topic)),
        'subscribers': _named(node.get_subscriptions_info_by_topic(topic)),
    }


def mismatches(node: Node, topic: str) -> list[str]:
    """
    Find pairs of nodes with incompatible QoS, between which no messages are exchanged.

    A node may have several endpoints, of which one compatible endpoint suffices.

    Parameters
    ----------
    node
        The node that is queried for the graph.
    topic
        The fully qualified name of the topic.

    Returns
    -------
    list of str
        At most 5 messages; none if there are more than 1000 pairs of endpoints.

    """
    publishers = node.get_publishers_info_by_topic(topic)
    subscribers = node.get_subscriptions_info_by_topic(topic)
    if len(publishers) * len(subscribers) > 1000:
        return []
    reasons: dict[tuple[str, str], set[str]] = {}
    for publisher in publishers:
        for subscriber in subscribers:
            ends = (_name(publisher), _name(subscriber))
            reasons.setdefault(ends, set()).add(_reason(publisher, subscriber))
    return sorted(
        f'Nothing passes from {publisher} to {subscriber}: {reason}.'
        for (publisher, subscriber), found in reasons.items()
        if '' not in found
        for reason in found
    )[:MOST]


def _named(ends: list[Any]) -> list[tuple[str, str]]:
    return sorted((_name(end), _quality(end.qos_profile)) for end in ends)


def _name(end: Any) -> str:
    return f'{end.node_namespace.rstrip("/")}/{end.node_name}'


def _quality(profile: Any) -> str:
    names = (profile.reliability.name, profile.durability.name)
    return ', '.join(SHORT.get(name, name.lower()) for name in names)


def _reason(publisher: Any, subscriber: Any) -> str:
    """Format the reason for incompatible QoS profiles; '' if they are compatible."""
    status, reason = qos_check_compatible(publisher.qos_profile, subscriber.qos_profile)
    if status != QoSCompatibility.ERROR:
        return ''
    return '; '.join(str(reason).replace('ERROR: ', '').strip(' ;').split(';'))
