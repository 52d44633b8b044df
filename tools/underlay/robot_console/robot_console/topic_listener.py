# SPDX-License-Identifier: Apache-2.0
"""Hear topics whose types are only known once somebody publishes them."""

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
"""More than most topics say in a tenth of a second; what is older is lost."""


class TopicListener:
    """
    Hears topics as soon as they are there; their messages wait until `take_all` is called.

    Times are those at which a message came to this machine.
    """

    def __init__(
        self, node: Node, full_name: Callable[[str], str], found: FoundType, take: Take
    ) -> None:
        """
        Take what makes a full name of a topic, and what gets its type and its messages.

        `full_name` raises ValueError for what is no name; that is then the reason of the topic.
        """
        self._node, self._full_name = node, full_name
        self._found, self._take = found, take
        self._heard: dict[str, PolledTopic] = {}

    def listen(self, topics: Collection[str]) -> dict[str, str]:
        """Hear these topics only; return why nothing comes on some of them."""
        for topic in set(self._heard).difference(topics):
            self._heard.pop(topic).close()
        missing = [topic for topic in topics if topic not in self._heard]
        reasons = self._subscribe_all(missing) if missing else {}
        for topic, heard in self._heard.items():
            if not self._node.count_publishers(heard.topic):
                reasons[topic] = f'Nobody publishes {heard.topic}.'
        return reasons

    def take_all(self) -> None:
        """Pass on what has come since the last time, in the order in which it came."""
        news = [
            (time_s, topic, message)
            for topic, heard in self._heard.items()
            for message, time_s in heard.take()
        ]
        for time_s, topic, message in sorted(news, key=itemgetter(0)):
            self._take(topic, message, time_s)

    def close(self) -> None:
        """Hear nothing any longer."""
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
        """Subscribe a topic, or raise ValueError with the reason."""
        from rclpy.qos import QoSProfile, ReliabilityPolicy

        if not types:
            raise ValueError(f'Nobody publishes {name}.')
        if len(types) > 1:
            raise ValueError(f'{name} has several types: {", ".join(types)}.')

        qos = QoSProfile(depth=DEPTH, reliability=ReliabilityPolicy.BEST_EFFORT)
        kind = message_class(types[0])
        self._heard[topic] = PolledTopic(self._node, kind, name, qos)
        self._found(topic, types[0])
