# SPDX-License-Identifier: Apache-2.0
"""Print the messages of a topic as they arrive."""

from __future__ import annotations

import argparse
from collections.abc import Callable
import sys
import time
from typing import Any

from rclpy.event_handler import SubscriptionEventCallbacks
from ros2cli.patience import Patience
from ros2topic.api import closest_topic
from ros2topic.api.draining import drain
from ros2topic.api.incompatibility import Incompatibility
from ros2topic.api.losses import LossCounter, lost_text
from ros2topic.api.printing import formatter
from ros2topic.api.qos import choose_qos

PERIOD_S = 0.1


def echo(node: Any, topic: str, message_type: Any, args: argparse.Namespace) -> None:
    """
    Print the messages of a topic, optionally until the first one or a timeout.

    Parameters
    ----------
    node
        The `DirectNode` that subscribes.
    topic
        Full name of the topic.
    message_type
        The class of the messages.
    args : argparse.Namespace
        The parsed command line of `ros2 topic echo`, with `timeout` in s or None.

    Raises
    ------
    RuntimeError
        The filter or the chosen field does not fit the messages.

    """
    end = time.monotonic() + (args.timeout if args.timeout is not None else float('inf'))
    listener = Listener(node, topic, message_type, args)

    def hint() -> str:
        if listener.has_received:
            return 'Messages come, but none passes the filter.'
        graph = node.graph
        if graph.count_publishers(topic):
            return ''
        return f'Nobody publishes it. {closest_topic(graph, topic)}'

    listener.listen(end, Patience(f"a message on '{topic}'", hint))


class Listener:
    """
    Subscribes to a topic and prints the messages that it receives.

    Unless the options override it, the QoS matches all publishers.

    Parameters
    ----------
    node
        The `DirectNode` that subscribes.
    topic
        Full name of the topic.
    message_type
        The class of the messages.
    args : argparse.Namespace
        The parsed command line: the options of `add_qos_arguments` and `add_form_arguments`, and
        `filter`, `no_lost_messages`, `once` and `raw`.
    format_message
        Formats a message and its message info; by default `formatter(args)`.

    Attributes
    ----------
    count
        The number of printed messages.
    has_received
        Whether any message has been received, even one that the filter rejects.

    """

    def __init__(
        self,
        node: Any,
        topic: str,
        message_type: Any,
        args: argparse.Namespace,
        format_message: Callable[[Any, Any], str] | None = None,
    ) -> None:
        profile, notices = choose_qos(args, node.graph.get_publishers_info_by_topic(topic))
        for notice in notices:
            print(notice)
        self.count = 0
        self.has_received = False
        self._node = node
        self._once = args.once
        self._accepts = args.filter or _accept_all
        self._format = format_message or formatter(args)
        self._tells_losses = not args.no_lost_messages
        self._topic = topic
        self._losses = LossCounter(self._has_one_publisher)
        self._incompatibility = Incompatibility(node, topic, profile)
        self._subscription = node.create_subscription(
            message_type,
            topic,
            self._receive,
            profile,
            event_callbacks=SubscriptionEventCallbacks(
                incompatible_qos=self._incompatibility.on_event,
                message_lost=None if args.no_lost_messages else self._report_lost,
            ),
            raw=args.raw,
        )

    def listen(self, end_s: float, patience: Patience) -> None:
        """
        Spin and print messages until the end, or until the first one if `once` is set.

        Parameters
        ----------
        end_s
            The end time, in s of the monotonic clock.
        patience
            Reports the wait on stderr if nothing has been printed for a while.

        """
        while time.monotonic() < end_s and not (self._once and self.count):
            self._node.spin_once(min(PERIOD_S, max(0.0, end_s - time.monotonic())))
            self._incompatibility.check()
            if not self.count:
                patience.check()

    def _receive(self, message: Any, info: Any) -> None:
        """Print a message and all pending ones, in one write."""
        texts = self._texts(message, info)
        for each in drain(self._subscription):
            texts += self._texts(*each)
        if texts:
            sys.stdout.write(''.join(texts))
            sys.stdout.flush()

    def _texts(self, message: Any, info: Any) -> list[str]:
        if self._once and self.count:
            return []
        gap = self._losses.report_gap(info) if self._tells_losses else ''
        self.has_received = True
        if not self._accepts(message):
            return [gap]
        self.count += 1
        return [gap, self._format(message, info)]

    def _has_one_publisher(self) -> bool:
        return bool(self._node.count_publishers(self._topic) == 1)

    def _report_lost(self, status: Any) -> None:
        """Report a loss detected by the middleware, unless a sequence gap will reveal it."""
        if not self._has_one_publisher():
            print(lost_text(status.total_count_change, status.total_count), end='')


def _accept_all(message: Any) -> bool:
    return True
