# SPDX-License-Identifier: Apache-2.0
"""Panel with the topics of a robot, their publishers and subscribers, and QoS mismatches."""

from __future__ import annotations

from collections.abc import Mapping
import time
from typing import Any, TYPE_CHECKING

from rclpy.qos import qos_check_compatible, QoSCompatibility
from robot_console.live_panel import LivePanel
from robot_console.topic_rates import RateListener
from robot_console.topic_watch import TopicWatch
from rviz_common.topics import is_full_topic_name

if TYPE_CHECKING:
    from rclpy.node import Node
from rviz_common.page.channel import Action, Viewer

__all__ = ['Topics']

_Row = tuple[str, str, int, int]
SHORT = {
    'RELIABLE': 'reliable',
    'BEST_EFFORT': 'best effort',
    'TRANSIENT_LOCAL': 'transient local',
    'VOLATILE': 'volatile',
}
MOST = 5


def _types_of(node: Node) -> dict[str, list[str]]:
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


def _rows_of(node: Node, types: dict[str, list[str]]) -> list[_Row]:
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


def _ends_of(node: Node, topic: str) -> dict[str, list[tuple[str, str]]]:
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


def _mismatches(node: Node, topic: str) -> list[str]:
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


class Topics(LivePanel):
    """
    All topics, with types and ends; rates when they are wanted, and the newest message of one.

    Only topics that a viewer has selected are subscribed to.
    """

    CLASS = 'robot_console/Topics'
    PAGE = 'topics'
    PERIOD_S = 0.5

    def settings(self) -> dict[str, Any]:
        """Return the initial settings of the page."""
        namespace = self.values['Namespace']
        return {'below': f'/{namespace}/' if namespace else '/', 'me': self._own_name()}

    def actions(self) -> Mapping[str, Action]:
        """Return the actions that the page may request."""
        return {'choose': self._choose, 'rates': self._want_rates}

    def begin(self) -> None:
        """Initialise the panel; topics are subscribed to only on request."""
        node = self.context.node
        self._rates = RateListener(node, self.context.queue.post)
        self._watches: dict[str, TopicWatch] = {}
        self._want: set[Viewer] = set()
        self._told: Any = None
        self._types: dict[str, list[str]] = {}

    def greet(self, viewer: Viewer) -> None:
        """
        Send the list of topics and known rates to a new viewer.

        Parameters
        ----------
        viewer
            As for `LivePanel.greet`.

        """
        self._types = _types_of(self.context.node)
        self._told = self._state()
        viewer.tell(**self._told)

    def refresh(self) -> None:
        """Update the subscriptions, and send changes to the viewers."""
        viewers = self.channel.viewers
        self._want.intersection_update(viewers)
        if viewers:
            self._types = _types_of(self.context.node)
        self._measure()
        self._follow({viewer.wish for viewer in viewers if viewer.wish})
        if not viewers:
            return
        state = self._state()
        if state != self._told:
            self._told = state
            self.channel.tell(**state)
        self._tell_details()

    def end(self) -> None:
        """Destroy all subscriptions."""
        self._rates.stop()
        self._follow(set())

    def _state(self) -> dict[str, Any]:
        measured = self._rates.survey.measured
        rates = {topic: _rate_text(*measured[topic]) for topic in self._types if topic in measured}
        return {'rows': _rows_of(self.context.node, self._types), 'rates': rates}

    def _measure(self) -> None:
        if self._want:
            self._rates.update(self._types, time.monotonic())
        else:
            self._rates.stop()

    def _follow(self, wanted: set[str]) -> None:
        """Watch only the topics that viewers have selected."""
        types = {topic: self._types[topic] for topic in wanted if topic in self._types}
        for topic, watch in list(self._watches.items()):
            if types.get(topic) != watch.type_names:
                self._watches.pop(topic).close()
        for topic in set(types) - set(self._watches):
            self._watches[topic] = TopicWatch(self.context.node, topic, types[topic])
        for watch in self._watches.values():
            watch.update()

    def _tell_details(self) -> None:
        details = {topic: self._details(topic) for topic in self._watches}
        for viewer in self.channel.viewers:
            if viewer.wish:
                viewer.tell(details=details.get(viewer.wish) or {'topic': viewer.wish})

    def _details(self, topic: str) -> dict[str, Any]:
        watch, node, now_s = self._watches[topic], self.context.node, time.time()
        return {
            'topic': topic,
            'type': ', '.join(self._types.get(topic, ())),
            'rate': watch.window.rate_hz(now_s),
            'bytes': watch.window.bytes_per_s(now_s),
            'age': watch.window.age_s(now_s),
            'count': watch.window.count,
            'size': watch.size,
            'text': watch.text,
            'reasons': [watch.reason] if watch.reason else _mismatches(node, topic),
            **_ends_of(node, topic),
        }

    def _choose(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        topic = message.get('topic')
        viewer.wish = topic if isinstance(topic, str) else None
        self._pace.hurry()

    def _want_rates(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        if message.get('on') is True:
            self._want.add(viewer)
        else:
            self._want.discard(viewer)
        self._pace.hurry()

    def _own_name(self) -> str:
        name: str = self.context.node.get_fully_qualified_name()
        return name


def _rate_text(rate_hz: float | None, came: bool) -> str:
    """Format a rate with three significant digits."""
    if rate_hz is None:
        return '< 0.5 Hz' if came else 'quiet'
    digits = 0 if rate_hz >= 100 else 1 if rate_hz >= 10 else 2
    return f'{rate_hz:.{digits}f} Hz'
