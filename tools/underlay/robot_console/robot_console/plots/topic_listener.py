# SPDX-License-Identifier: Apache-2.0
"""How a plot receives messages of topics whose types are unknown until they are published."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from functools import cache
from operator import itemgetter
import time
from typing import Any, TYPE_CHECKING

from robot_console.plots.series import PathError
from rviz_common.polled_topic import PolledTopic

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['Samples', 'TopicListener', 'fields_of']

Take = Callable[[str, Any, float], None]
FoundType = Callable[[str, str], None]
DEPTH = 200
"""More messages than most topics publish in 0.1 s; older messages are lost."""

Done = Callable[[Mapping[str, Any]], None]
TIMEOUT_S = 1.5


@cache
def _message_class(type_name: str) -> Any:
    """
    Import the class of a message type.

    Parameters
    ----------
    type_name
        For example `std_msgs/msg/String`.

    Raises
    ------
    PathError
        The type is not installed, or cannot be imported.

    """
    from ros2cli.messages.lookup import get_message, UnknownType

    try:
        return get_message(type_name)
    except UnknownType as error:
        raise PathError(f'{type_name} cannot be read: {error}.') from error


@cache
def fields_of(type_name: str) -> Mapping[str, str]:
    """
    Return the fields of a message type.

    Parameters
    ----------
    type_name
        For example `std_msgs/msg/String`.

    Returns
    -------
    Mapping
        The field types in IDL notation, such as `sequence<double>`, by field name.

    Raises
    ------
    PathError
        The type is not installed, or cannot be imported.

    """
    fields: Mapping[str, str] = _message_class(type_name).get_fields_and_field_types()
    return fields


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
                reasons[topic] = f'No publisher on {heard.topic}.'
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
            raise ValueError(f'No publisher on {name}.')
        if len(types) > 1:
            raise ValueError(f'{name} has several types: {", ".join(types)}.')

        qos = QoSProfile(depth=DEPTH, reliability=ReliabilityPolicy.BEST_EFFORT)
        kind = _message_class(types[0])
        self._heard[topic] = PolledTopic(self._node, kind, name, qos)
        self._found(topic, types[0])


class Samples:
    """
    Receives one message from each of several topics, with a timeout.

    Parameters
    ----------
    node
        The node that subscribes.
    full_name
        Resolves a topic name, or raises ValueError.

    """

    def __init__(self, node: Node, full_name: Callable[[str], str]) -> None:
        self._listener = TopicListener(node, full_name, lambda topic, kind: None, self._take)
        self._topics: frozenset[str] = frozenset()
        self._messages: dict[str, Any] = {}
        self._done: Done | None = None
        self._end_s = 0.0

    def ask(self, topics: Collection[str], done: Done) -> None:
        """
        Request a message from each of several topics; a pending request is dropped.

        Call `update` until `done` is called.

        Parameters
        ----------
        topics
            The names, which `full_name` resolves.
        done
            Called by `update` with the messages by topic; those not received within 1.5 s are
            missing.

        """
        self._listener.close()
        self._topics, self._done = frozenset(topics), done
        self._messages = {}
        self._end_s = time.monotonic() + TIMEOUT_S
        self._listener.listen(self._topics)

    def update(self) -> None:
        """Complete the request once all messages have arrived or the timeout has expired."""
        done = self._done
        if done is None:
            return
        self._listener.take_all()
        if len(self._messages) == len(self._topics) or time.monotonic() > self._end_s:
            self.close()
            done(self._messages)

    def close(self) -> None:
        """Cancel the request."""
        self._listener.close()
        self._done = None

    def _take(self, topic: str, message: Any, time_s: float) -> None:
        self._messages.setdefault(topic, message)
