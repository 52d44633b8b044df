# SPDX-License-Identifier: Apache-2.0
"""Short subscriptions that measure the rates of topics."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from typing import Any, TYPE_CHECKING

from robot_console.topics.survey import Survey
from robot_console.topics.topic_watch import received_s
from ros2cli.messages.lookup import get_message, UnknownType

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['RateListener']

DEPTH = 50


class RateListener:
    """
    Measures the rates of topics with short subscriptions that do not decode messages.

    Parameters
    ----------
    node
        The node that subscribes.
    later
        Schedules a function in the thread of the node.

    Attributes
    ----------
    survey
        Plans the measurements and stores the results.

    """

    def __init__(self, node: Node, later: Callable[[Callable[[], None]], None]) -> None:
        self.survey = Survey()
        self._node = node
        self._later = later
        self._subscriptions: dict[str, Any] = {}

    def update(self, types: Mapping[str, list[str]], now_s: float) -> None:
        """
        Subscribe to the topics whose turn it is, and to no others.

        Parameters
        ----------
        types
            The type names of all topics, by topic name; topics of unknown or several types are
            skipped.
        now_s
            The current time, from `time.monotonic`.

        """
        kinds = {topic: _kind(names) for topic, names in types.items()}
        readable = {topic: kind for topic, kind in kinds.items() if kind is not None}
        wanted = self.survey.plan(readable, now_s)
        for topic in set(self._subscriptions) - wanted:
            self._drop(topic)
        for topic in wanted - set(self._subscriptions):
            self._listen(topic, readable[topic])

    def stop(self) -> None:
        """Destroy all subscriptions."""
        self.survey.stop()
        for topic in list(self._subscriptions):
            self._drop(topic)

    def _listen(self, topic: str, kind: Any) -> None:
        from rclpy.event_handler import SubscriptionEventCallbacks
        from rclpy.qos import QoSProfile, ReliabilityPolicy

        def take(raw: bytes, info: Any) -> None:
            if self.survey.hear(topic, received_s(info), len(raw)):
                self._later(lambda: self._drop(topic))

        qos = QoSProfile(depth=DEPTH, reliability=ReliabilityPolicy.BEST_EFFORT)
        quiet = SubscriptionEventCallbacks(use_default_callbacks=False)
        self._subscriptions[topic] = self._node.create_subscription(
            kind, topic, take, qos, raw=True, event_callbacks=quiet
        )

    def _drop(self, topic: str) -> None:
        subscription = self._subscriptions.pop(topic, None)
        if subscription is not None:
            self._node.destroy_subscription(subscription)


def _kind(type_names: list[str]) -> Any:
    """Return the message class of a topic; None if it is unknown or ambiguous."""
    return _class_of(type_names[0]) if len(type_names) == 1 else None


@cache
def _class_of(type_name: str) -> Any:
    try:
        return get_message(type_name)
    except UnknownType:
        return None
