# SPDX-License-Identifier: Apache-2.0
"""Listen for a moment to topics whose rate is to be known."""

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
        Runs a function soon, in the thread of the node.

    Attributes
    ----------
    survey
        Decides what to measure, and has the results.

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
            The names of the types of all topics, by name; those of unknown or several types are
            skipped.
        now_s
            The time of `time.monotonic`.

        """
        kinds = {topic: _kind(names) for topic, names in types.items()}
        readable = {topic: kind for topic, kind in kinds.items() if kind is not None}
        wanted = self.survey.plan(readable, now_s)
        for topic in set(self._subscriptions) - wanted:
            self._drop(topic)
        for topic in wanted - set(self._subscriptions):
            self._listen(topic, readable[topic])

    def stop(self) -> None:
        """Listen no longer."""
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
    """Return the class of a topic's messages; None if there is none, or more than one."""
    return _class_of(type_names[0]) if len(type_names) == 1 else None


@cache
def _class_of(type_name: str) -> Any:
    try:
        return get_message(type_name)
    except UnknownType:
        return None
