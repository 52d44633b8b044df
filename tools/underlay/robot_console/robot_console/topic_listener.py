# SPDX-License-Identifier: Apache-2.0
"""Subscriptions to topics whose types are unknown until they are published."""

from __future__ import annotations

from collections.abc import Callable, Collection
from operator import itemgetter
from typing import Any, TYPE_CHECKING

from robot_console.message_types import message_class
from rviz_common.polled_topic import PolledTopic

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['TopicListener']

Take = Callable[[str, Any, float], None]
FoundType = Callable[[str, str], None]
DEPTH = 200
"""More messages than most topics publish in 0.1 s; older messages are lost."""


class TopicListener:
    """
    Subscribes to topics as soon as their types are known; `take_all` passes on their messages.

    Times are those of reception on this machine.

    Parameters
    ----------
    node
        The node that subscribes.
    full_name
        Resolves a topic name; a ValueError that it raises becomes the error of that topic.
    found
        Called with a topic and the name of its type when it is subscribed to.
    take
        Called with a topic, a message and its time of reception (`time.time`, in s).

    """

    def __init__(
        self, node: Node, full_name: Callable[[str], str], found: FoundType, take: Take
    ) -> None:
        self._node, self._full_name = node, full_name
        self._found, self._take = found, take
        self._heard: dict[str, PolledTopic] = {}

    def listen(self, topics: Collection[str]) -> dict[str, str]:
        """
        Subscribe to these topics only.

        Call it periodically: topics without publishers are subscribed to once they are published.

        Parameters
        ----------
        topics
            The names, which `full_name` resolves.

        Returns
        -------
        dict
            Messages that explain why nothing is received, by topic; working topics are missing.

        """
        for topic in set(self._heard).difference(topics):
            self._heard.pop(topic).close()
        missing = [topic for topic in topics if topic not in self._heard]
        reasons = self._subscribe_all(missing) if missing else {}
        for topic, heard in self._heard.items():
            if not self._node.count_publishers(heard.topic):
                reasons[topic] = f'Nobody publishes {heard.topic}.'
        return reasons

    def take_all(self) -> None:
        """Deliver the messages received since the last call, in order of reception."""
        news = [
            (time_s, topic, message)
            for topic, heard in self._heard.items()
            for message, time_s in heard.take()
        ]
        for time_s, topic, message in sorted(news, key=itemgetter(0)):
            self._take(topic, message, time_s)

    def close(self) -> None:
        """Destroy all subscriptions."""
        self.listen(())

    def _subscribe_all(self, topics: Collection[str]) -> dict[str, str]:
        types = dict(self._node.get_topic_names_and_types())
        reasons = {}
        for topic in topics:
            try:
                name = self._full_name(topic)
                self._subscribe(topic, name, types.get(name, []))
            except ValueError as error:
                reasons[topic] = str(error)
        return reasons

    def _subscribe(self, topic: str, name: str, types: list[str]) -> None:
        """Subscribe to a topic, or raise ValueError with the reason."""
        from rclpy.qos import QoSProfile, ReliabilityPolicy

        if not types:
            raise ValueError(f'Nobody publishes {name}.')
        if len(types) > 1:
            raise ValueError(f'{name} has several types: {", ".join(types)}.')

        qos = QoSProfile(depth=DEPTH, reliability=ReliabilityPolicy.BEST_EFFORT)
        kind = message_class(types[0])
        self._heard[topic] = PolledTopic(self._node, kind, name, qos)
        self._found(topic, types[0])
