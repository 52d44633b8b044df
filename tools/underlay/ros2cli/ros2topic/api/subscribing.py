# SPDX-License-Identifier: Apache-2.0
"""Subscribe to a topic: with which type, from which message on; and report on it once a second."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from itertools import chain
import sys
import time
from typing import Any

from rclpy.event_handler import SubscriptionEventCallbacks
from ros2cli.messages.lookup import get_passed_type
from ros2cli.waiting import Patience, spin_until
from ros2topic.api import closest_topic, get_topic_types, type_mismatch
from ros2topic.api.qos import Incompatibility, matching_qos

USUAL_DELAY_NS = 50_000_000
CONNECTION_NS = 2_000_000_000
MOST_AT_ONCE = 500
PERIOD_S = 1.0


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


def resolve_type(node: Any, topic: str, name: str | None) -> Any:
    """
    Find the message class for a subscription.

    Without a name the type is read from the graph; the topic is waited for during the spin time.

    Parameters
    ----------
    node
        The `DirectNode` that will subscribe.
    topic
        Full name of the topic.
    name
        The type given by the user, if any; a warning is printed if only other types are in use.

    Raises
    ------
    RuntimeError
        The named type is invalid; or, without a name, the topic has no type yet or several.

    """
    if not name:
        return get_passed_type(_discovered_type(node, topic), 'msg')
    message_type = get_passed_type(name, 'msg')
    mismatch = type_mismatch(node.graph, topic, message_type)
    if mismatch:
        print(f'WARNING: {mismatch}', file=sys.stderr)
    return message_type


def _discovered_type(node: Any, topic: str) -> str:
    graph = node.watch.settled_with(lambda graph: get_topic_types(graph, topic))
    types = get_topic_types(graph, topic)
    if not types:
        print(f'WARNING: topic [{topic}] does not appear to be published yet')
        text = 'Could not determine the type for the passed topic'
        raise RuntimeError('\n'.join([text, closest_topic(graph, topic)]).rstrip())
    if len(types) > 1:
        raise RuntimeError(
            f"Cannot echo topic '{topic}', as it contains more than one type: [{', '.join(types)}]"
        )
    return types[0]


class Backlog:
    """
    Filter for messages that were published before the subscription was connected.

    A reliable publisher discovers us some time before we discover it, and repeats the messages
    published in between in one burst, which is not representative of its rate.
    """

    def __init__(self) -> None:
        """Start before the first message."""
        self._start_ns: int | None = None

    def has(self, info: Mapping[str, int]) -> bool:
        """
        Check whether a message was published before the subscription was connected.

        Call once for each message, in the order of arrival.

        Parameters
        ----------
        info
            The message info of rclpy, with `source_timestamp` and `received_timestamp` in ns.

        Returns
        -------
        bool
            Whether the message was delivered late, as part of the backlog.

        """
        received_ns, source_ns = info['received_timestamp'], info['source_timestamp']
        if self._start_ns is None:
            self._start_ns = received_ns
            return received_ns - source_ns > USUAL_DELAY_NS
        return source_ns < self._start_ns and received_ns < self._start_ns + CONNECTION_NS


def drain(subscription: Any) -> Iterator[tuple[Any, Any]]:
    """
    Yield the pending messages of a subscription, at most 500.

    Parameters
    ----------
    subscription
        The subscription of rclpy.

    Yields
    ------
    tuple
        The message, as bytes if the subscription is raw, and its message info.

    """
    handle = subscription.handle
    with handle:
        for _ in range(MOST_AT_ONCE):
            taken = handle.take_message(subscription.msg_type, subscription.raw)
            if taken is None:
                return
            yield taken


def report_for_ever(
    node: Any, topic: str, report: Callable[[], str], incompatibility: Incompatibility
) -> None:
    """
    Print a report about a topic once a second, endlessly.

    Parameters
    ----------
    node
        The `DirectNode` to spin in between.
    topic
        Full name of the topic, for the message about missing messages.
    report
        Returns the text, or '' if there is nothing new.
    incompatibility
        Checked once per period for nodes that cannot connect.

    """
    patience = Patience(f"messages on '{topic}'")
    while True:
        spin_until(node, time.monotonic() + PERIOD_S)
        incompatibility.check()
        text = report()
        if text:
            print(text)
        else:
            patience.check()
