# SPDX-License-Identifier: Apache-2.0
"""Subscribe to a topic once it is published, for verbs that measure it."""

from __future__ import annotations

from collections.abc import Callable
from itertools import chain
from typing import Any

from rclpy.event_handler import SubscriptionEventCallbacks
from ros2cli.patience import Patience
from ros2topic.api import closest_topic, get_topic_types
from ros2topic.api.backlog import Backlog
from ros2topic.api.draining import drain
from ros2topic.api.incompatibility import Incompatibility
from ros2topic.api.qos import matching_qos
from ros2topic.api.subscription_type import resolve_type


def subscribe_when_published(
    node: Any,
    topic: str,
    callback: Callable[[Any, float], None],
    *,
    raw: bool = True,
    check: Callable[[Any], object] = bool,
) -> Incompatibility:
    """
    Wait until a topic is published, then subscribe to it.

    Messages that were published before the subscription was connected are left out.

    Parameters
    ----------
    node
        The `DirectNode` that subscribes.
    topic
        Full name of the topic.
    callback
        Accepts each message and its arrival time, in s since 1970.
    raw
        Whether the callback gets serialized messages (bytes).
    check
        Accepts the message class before the subscription is created; may raise RuntimeError.

    Returns
    -------
    Incompatibility
        The report to check regularly for publishers that cannot connect.

    Raises
    ------
    RuntimeError
        The topic has several types, or one that is not installed.

    """
    _wait_until_published(node, topic)
    message_type = resolve_type(node, topic, None)
    check(message_type)
    profile, _ = matching_qos(node.graph.get_publishers_info_by_topic(topic))
    incompatibility = Incompatibility(node, topic, profile)
    backlog = Backlog()

    def receive(message: Any, info: Any) -> None:
        for each, times in chain([(message, info)], drain(subscription)):
            if not backlog.has(times):
                callback(each, times['received_timestamp'] / 1e9)

    subscription = node.create_subscription(
        message_type,
        topic,
        receive,
        profile,
        raw=raw,
        event_callbacks=SubscriptionEventCallbacks(incompatible_qos=incompatibility.on_event),
    )
    return incompatibility


def _wait_until_published(node: Any, topic: str) -> None:
    if get_topic_types(node.graph, topic):
        return
    print(f'WARNING: topic [{topic}] does not appear to be published yet')

    def hint() -> str:
        return closest_topic(node.watch.graph, topic)

    patience = Patience(f"a publisher of '{topic}'", hint)
    node.watch.wait_for(lambda graph: get_topic_types(graph, topic), patience)
