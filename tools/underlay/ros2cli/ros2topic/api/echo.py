# SPDX-License-Identifier: Apache-2.0
"""Print the messages of a topic as they arrive, and how many are lost."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping
import sys
import time
from typing import Any

from rclpy.event_handler import SubscriptionEventCallbacks
from ros2cli.messages.lookup import field_hint
from ros2cli.messages.text import Shortening, to_csv, to_yaml
from ros2cli.waiting import Patience
from ros2topic.api import closest_topic
from ros2topic.api.qos import choose_qos, Incompatibility
from ros2topic.api.subscribing import drain

PERIOD_S = 0.1
SEPARATOR = '---'


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
            return 'Messages arrive, but none passes the filter.'
        graph = node.graph
        if graph.count_publishers(topic):
            return ''
        return f'It has no publisher. {closest_topic(graph, topic)}'

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


def formatter(args: argparse.Namespace) -> Callable[[Any, Any], str]:
    """
    Create the function that formats messages according to the options.

    Parameters
    ----------
    args : argparse.Namespace
        The parsed command line of `ros2 topic echo`.

    Returns
    -------
    callable
        Accepts a message, as bytes if `raw` is set, and its message info; returns the text with
        the separator. It raises RuntimeError if the messages lack the chosen field.

    """
    shortening = chosen_shortening(args)
    end = '\n' if args.csv and not args.raw else f'{SEPARATOR}\n'

    def format_message(message: Any, info: Any) -> str:
        value = nested_field(message, args.field) if args.field else message
        texts = [to_yaml(info)] if args.include_message_info else []
        return ''.join([*texts, value_text(value, shortening, args), end])

    return format_message


def chosen_shortening(args: argparse.Namespace) -> Shortening:
    """
    Read the limits for strings and arrays from the options.

    Parameters
    ----------
    args : argparse.Namespace
        The parsed command line with the options of `add_form_arguments`.

    """
    length = None if args.full_length else args.truncate_length
    return Shortening(length, args.no_arr, args.no_str)


def nested_field(message: Any, path: str) -> Any:
    """
    Get the value of a nested field of a message.

    Parameters
    ----------
    message
        The message.
    path
        The names of the nested fields, joined by dots, such as `pose.position`.

    Raises
    ------
    RuntimeError
        The message has no such field; the error suggests one if a name is close.

    """
    value = message
    for name in path.split('.'):
        if name not in getattr(value, 'get_fields_and_field_types', dict)():
            text = f"'{type(value).__name__}' object has no attribute '{name}'"
            error = AttributeError(text, name=name, obj=value)
            lines = [f"Invalid field '{path}': {error}", field_hint(error)]
            raise RuntimeError('\n'.join(lines).rstrip())
        value = getattr(value, name)
    return value


def value_text(value: Any, shortening: Shortening, args: argparse.Namespace) -> str:
    """
    Format a message or the value of a field as YAML or CSV.

    Parameters
    ----------
    value
        The message, the value of a field, or the bytes of a serialized message.
    shortening
        The limits for strings and arrays.
    args : argparse.Namespace
        The parsed command line: `csv`, `raw` and `flow_style` choose the format.

    Returns
    -------
    str
        The text, with a final line break unless it is CSV.

    """
    if args.csv and not args.raw:
        return to_csv(value, shortening)
    if isinstance(value, bytes):
        return f'{value!r}\n'
    if isinstance(value, (bool, int, float, str)):
        return f'{value}\n'
    return to_yaml(value, shortening, flow_style=args.flow_style)


class LossCounter:
    """
    Counter of the gaps in the sequence numbers of a publisher.

    A queue that overflows because the reader is slow drops messages without an event. The sequence
    numbers reveal this, as long as they all come from one publisher.

    Parameters
    ----------
    has_one_publisher
        Whether the topic has exactly one publisher; only called when there is a gap.

    Attributes
    ----------
    total
        The number of messages lost so far.

    """

    def __init__(self, has_one_publisher: Callable[[], bool]) -> None:
        self._has_one_publisher = has_one_publisher
        self._last: int | None = None
        self.total = 0

    def report_gap(self, info: Mapping[str, Any]) -> str:
        """
        Count the messages missing before this one, and format the report.

        Call once for each message, in the order of arrival.

        Parameters
        ----------
        info
            The message info of rclpy, with `publication_sequence_number`, which may be None.

        Returns
        -------
        str
            The report, or '' if nothing is known to be missing.

        """
        number = info['publication_sequence_number']
        if number is None:
            return ''
        lost = 0 if self._last is None else number - self._last - 1
        self._last = number
        if lost <= 0 or not self._has_one_publisher():
            return ''
        self.total += lost
        return lost_text(lost, self.total)


def lost_text(change: int, total: int) -> str:
    """
    Format the report of lost messages that is printed between messages.

    Parameters
    ----------
    change, total
        The number of messages lost since the last report, and in total.

    """
    return f'A message was lost!!!\n\ttotal count change:{change}\n\ttotal count: {total}---\n'
