# SPDX-License-Identifier: Apache-2.0
"""How one topic is watched: its rate, and its latest message as text."""

from __future__ import annotations

from collections import deque
from functools import cache
import time
from typing import Any, TYPE_CHECKING

from ros2cli.messages.lookup import get_message, UnknownType
from ros2cli.messages.text import element_type, Shortening, to_yaml
from ros2topic.api.qos import matching_qos
from ros2topic.verb.bw import human_bytes

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['RateWindow', 'TopicWatch', 'decoded', 'has_lists_of_messages', 'received_s']

WINDOW_S = 10.0
MOST = 500

SHORT = Shortening(length=64)
LONGEST_TEXT = 20_000
MOST_BYTES_FLAT = 32_000_000
MOST_BYTES_NESTED = 300_000

DEPTH = 100
SHARE = 0.03
"""The maximum fraction of time spent on decoding messages to text."""


class RateWindow:
    """
    Sliding window of the times and sizes of messages, to estimate their rate.

    Parameters
    ----------
    window_s
        The length of the window, in s.
    most
        The maximum number of messages in the window.

    Attributes
    ----------
    count
        The total number of messages received.

    """

    def __init__(self, window_s: float = WINDOW_S, most: int = MOST) -> None:
        self._window_s = window_s
        self._messages: deque[tuple[float, int]] = deque(maxlen=most)
        self.count = 0

    def add(self, time_s: float, size: int) -> None:
        """
        Add a message; if time jumps back, earlier messages are dropped.

        Parameters
        ----------
        time_s
            The time of reception, in s.
        size
            Its size, in bytes.

        """
        if self._messages and time_s < self._messages[-1][0]:
            self._messages.clear()
        self._messages.append((time_s, size))
        self.count += 1

    def age_s(self, now_s: float) -> float | None:
        """
        Return the age of the latest message.

        Parameters
        ----------
        now_s
            The current time, of the same clock.

        Returns
        -------
        float or None
            In s; None if no message was received.

        """
        return max(now_s - self._messages[-1][0], 0.0) if self._messages else None

    def rate_hz(self, now_s: float) -> float | None:
        """
        Estimate the current message rate.

        Parameters
        ----------
        now_s
            The current time, of the same clock.

        Returns
        -------
        float or None
            In Hz; None with fewer than two messages, or after a silence that is long for this
            topic.

        """
        span = self._span(now_s)
        return None if span is None else (len(self._messages) - 1) / span

    def bytes_per_s(self, now_s: float) -> float | None:
        """
        Estimate the current bandwidth.

        Parameters
        ----------
        now_s
            The current time, of the same clock.

        Returns
        -------
        float or None
            In bytes per second; None as for `rate_hz`.

        """
        span = self._span(now_s)
        if span is None:
            return None
        return sum(size for _, size in list(self._messages)[1:]) / span

    def _span(self, now_s: float) -> float | None:
        """Compute the duration covered by the messages, extended by an unusual silence."""
        while len(self._messages) > 2 and now_s - self._messages[0][0] > self._window_s:
            self._messages.popleft()
        if len(self._messages) < 2:
            return None
        first, last = self._messages[0][0], self._messages[-1][0]
        usual = (last - first) / (len(self._messages) - 1)
        silence = now_s - last
        if silence > max(self._window_s, 3.0 * usual):
            return None
        span = last - first + (silence if silence > 3.0 * usual + 0.5 else 0.0)
        return span if span > 0.0 else None


def decoded(raw: bytes, kind: Any) -> str:
    """
    Decode a serialized message to text, truncated if it is long.

    Parameters
    ----------
    raw
        The serialized message.
    kind
        Its message class.

    Returns
    -------
    str
        YAML; for a message that would take too long, an explanation instead.

    """
    from rclpy.serialization import deserialize_message

    most = MOST_BYTES_NESTED if has_lists_of_messages(kind) else MOST_BYTES_FLAT
    if len(raw) > most:
        size, limit = human_bytes(len(raw)), human_bytes(most)
        return f'A message of {size} is not shown as text: the limit is {limit}.'
    text = to_yaml(deserialize_message(raw, kind), SHORT)
    if len(text) > LONGEST_TEXT:
        return f'{text[:LONGEST_TEXT]}\n... ({len(text) - LONGEST_TEXT} characters more)'
    return text


@cache
def has_lists_of_messages(kind: Any) -> bool:
    """
    Check whether a message class contains lists of messages at any depth, which decode slowly.

    Parameters
    ----------
    kind
        The message class.

    """
    for field_type in kind.get_fields_and_field_types().values():
        inner = element_type(field_type)
        if '/' in inner and (inner != field_type or has_lists_of_messages(get_message(inner))):
            return True
    return False


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
