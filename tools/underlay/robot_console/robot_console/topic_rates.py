# SPDX-License-Identifier: Apache-2.0
"""How the rates of all topics are measured, with a few short subscriptions at a time."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping
from functools import cache
from typing import Any, NamedTuple, TYPE_CHECKING

from robot_console.topic_watch import RateWindow, received_s
from ros2cli.messages.lookup import get_message, UnknownType

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['Measured', 'RateListener', 'Survey']

AT_A_TIME = 4
DURATION_S = 2.5
AGAIN_S = 10.0
ENOUGH_MESSAGES = 30
ENOUGH_BYTES = 8_000_000

DEPTH = 50


class Measured(NamedTuple):
    """Measured rate of a topic; None without messages, or with only one."""

    rate_hz: float | None
    came: bool


class _Probe:
    """A measurement in progress."""

    def __init__(self, now_s: float) -> None:
        self.end_s = now_s + DURATION_S
        self.window = RateWindow(DURATION_S + 1.0, ENOUGH_MESSAGES)
        self.size = 0
        self.last_s = 0.0

    def is_over(self, now_s: float) -> bool:
        is_enough = self.window.count >= ENOUGH_MESSAGES or self.size >= ENOUGH_BYTES
        return is_enough or now_s >= self.end_s

    def result(self) -> Measured:
        return Measured(self.window.rate_hz(self.last_s), self.window.count > 0)


class Survey:
    """
    Selects the topics to subscribe to for a short time, to measure their rates.

    A few are measured at a time, for 2.5 s or until 30 messages or 8 MB have arrived, so that
    hundreds of topics cost little, and fast or large ones the least.

    """

    def __init__(self) -> None:
        self.measured: dict[str, Measured] = {}
        self._probes: dict[str, _Probe] = {}
        self._again_s: dict[str, float] = {}

    def hear(self, topic: str, time_s: float, size: int) -> bool:
        """
        Count a message of a topic that is being measured.

        Parameters
        ----------
        topic
            The name of the topic.
        time_s
            The time of reception, in s.
        size
            Its size, in bytes.

        Returns
        -------
        bool
            True if the measurement of the topic is finished.

        """
        probe = self._probes.get(topic)
        if probe is None:
            return True
        probe.window.add(time_s, size)
        probe.size += size
        probe.last_s = time_s
        return probe.is_over(0.0)

    def plan(self, topics: Collection[str], now_s: float) -> set[str]:
        """
        Finish completed measurements, and start the next ones.

        Parameters
        ----------
        topics
            All topics that could be measured.
        now_s
            The current time, from `time.monotonic`.

        Returns
        -------
        set of str
            The topics to subscribe to now, at most four.

        """
        for topic in [each for each in self._probes if each not in topics]:
            del self._probes[topic]
        for topic, probe in list(self._probes.items()):
            if probe.is_over(now_s):
                self.measured[topic] = probe.result()
                self._again_s[topic] = now_s + AGAIN_S
                del self._probes[topic]
        for topic in self._next(topics, now_s):
            self._probes[topic] = _Probe(now_s)
        return set(self._probes)

    def stop(self) -> None:
        """Cancel all measurements; the results remain."""
        self._probes.clear()

    def _next(self, topics: Iterable[str], now_s: float) -> list[str]:
        """Return the topics to measure next, the least recently measured first."""
        due = [
            topic
            for topic in topics
            if topic not in self._probes and self._again_s.get(topic, 0.0) <= now_s
        ]
        due.sort(key=lambda topic: self._again_s.get(topic, 0.0))
        return due[: AT_A_TIME - len(self._probes)]


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
