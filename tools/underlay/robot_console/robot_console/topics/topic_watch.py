# SPDX-License-Identifier: Apache-2.0
"""Detailed monitoring of one topic."""

from __future__ import annotations

import time
from typing import Any, TYPE_CHECKING

from robot_console.topics.decoding import decoded
from robot_console.topics.rate_window import RateWindow
from ros2cli.messages.lookup import get_message, UnknownType
from ros2topic.api.qos import matching_qos

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['TopicWatch', 'received_s']

DEPTH = 100
SHARE = 0.03
"""The maximum fraction of time spent on decoding messages to text."""


class TopicWatch:
    """
    Subscribes to one topic: its rate, and periodically the latest message as text.

    Call `update` periodically; it subscribes with a QoS profile that matches the publishers.

    Parameters
    ----------
    node
        The node that subscribes.
    topic
        The fully qualified name of the topic.
    type_names
        Its types; it can be watched only if there is exactly one.

    Attributes
    ----------
    window
        The times and sizes of the latest messages.
    reason
        A message that explains why the topic cannot be monitored; '' if it can.
    text
        The latest decoded message.
    size
        The size of the latest message, in bytes.

    """

    def __init__(self, node: Node, topic: str, type_names: list[str]) -> None:
        self._node, self._topic = node, topic
        self.window = RateWindow()
        self.reason = ''
        self.text = ''
        self.size = 0
        self._raw: bytes | None = None
        self._next_s = 0.0
        self._subscription: Any = None
        self._qos: Any = None
        self.type_names = type_names
        self._kind = self._found_kind()

    def update(self) -> None:
        """Resubscribe if the QoS of the publishers has changed, and decode the latest message."""
        if self._kind is None:
            return
        publishers = self._node.get_publishers_info_by_topic(self._topic)
        qos, _ = matching_qos(publishers)
        if self._qos is None or _key(qos) != self._qos:
            self._subscribe(qos)
        now_s = time.monotonic()
        if self._raw is not None and now_s >= self._next_s:
            self._decode(self._raw)
            took_s = time.monotonic() - now_s
            self._next_s = now_s + took_s / SHARE
            self._raw = None

    def close(self) -> None:
        """Destroy the subscription."""
        if self._subscription is not None:
            self._node.destroy_subscription(self._subscription)
            self._subscription = None

    def _found_kind(self) -> Any:
        if len(self.type_names) != 1:
            self.reason = f'It has several types: {", ".join(self.type_names)}.'
            return None
        try:
            return get_message(self.type_names[0])
        except UnknownType as error:
            self.reason = f'Its messages cannot be read: {error}'
            return None

    def _subscribe(self, qos: Any) -> None:
        from rclpy.event_handler import SubscriptionEventCallbacks

        self.close()
        self._qos = _key(qos)
        qos.depth = DEPTH
        quiet = SubscriptionEventCallbacks(use_default_callbacks=False)
        self._subscription = self._node.create_subscription(
            self._kind, self._topic, self._take, qos, raw=True, event_callbacks=quiet
        )

    def _take(self, raw: bytes, info: Any) -> None:
        self.window.add(received_s(info), len(raw))
        self._raw, self.size = raw, len(raw)

    def _decode(self, raw: bytes) -> None:
        try:
            self.text = decoded(raw, self._kind)
        except Exception as error:  # any error in the received bytes
            self.text = f'The newest message cannot be read: {error}'


def received_s(info: Any) -> float:
    """
    Return the time at which a message was received on this machine.

    Parameters
    ----------
    info
        The message info of rclpy.

    Returns
    -------
    float
        In s, from `time.time`; the current time if the middleware does not provide it.

    """
    return float(info['received_timestamp'] / 1e9 or time.time())


def _key(qos: Any) -> tuple[Any, Any]:
    return qos.reliability, qos.durability
