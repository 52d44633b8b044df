# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 topic pub`, and how it publishes at a rate."""

from __future__ import annotations

import argparse
import time
from typing import Any

from ros2cli.arguments import (
    add_node_arguments,
    node_name,
    positive_int,
    positive_number,
    whole_number,
)
from ros2cli.messages.lookup import get_passed_type
from ros2cli.messages.outgoing import OutgoingMessage
from ros2cli.messages.values import add_values_arguments, values_text
from ros2cli.names import absolute
from ros2cli.waiting import Patience, spin_until
from ros2topic.api import closest_topic, type_mismatch
from ros2topic.api.arguments import add_qos_arguments
from ros2topic.verb import VerbExtension

PRIVATE = '~'
ANNOUNCE_S = 1.0
PERIOD_S = 0.02
SETTLE_S = 0.25


class PubVerb(VerbExtension):
    """Publish a message to a topic."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the message, the rate and the quality of service.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 topic pub`; unused.

        """
        _add_pub_arguments(parser)
        add_qos_arguments(parser, 'publisher')
        add_node_arguments(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Publish until the count is reached or the user stops it.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        """
        from ros2cli.node.direct import DirectNode

        message_type = get_passed_type(args.message_type, 'msg')
        if args.topic_name != PRIVATE:
            absolute(args.topic_name.removeprefix(PRIVATE))
        message = OutgoingMessage(message_type(), values_text(args))
        with DirectNode(args, node_name=args.node_name) as node:
            _publish(node, message, args)
        return None


def _add_pub_arguments(parser: argparse.ArgumentParser) -> None:
    """
    Add the topic, the message, the rate and count, and the wait options.

    Parameters
    ----------
    parser
        The parser of the verb.

    """
    parser.add_argument('topic_name', help="Name of the ROS topic to publish to (e.g. '/chatter')")
    parser.add_argument('message_type', help="Type of the ROS message (e.g. 'std_msgs/String')")
    add_values_arguments(parser, 'message')
    _add_count(parser)
    _add_waiting(parser)


def _add_count(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        '-r',
        '--rate',
        metavar='N',
        type=positive_number,
        default=1.0,
        help='Publishing rate in Hz (default: 1)',
    )
    parser.add_argument(
        '-p',
        '--print',
        metavar='N',
        type=whole_number,
        default=1,
        help='Only print every N-th published message (default: 1)',
    )
    group = parser.add_mutually_exclusive_group()
    group.add_argument('-1', '--once', action='store_true', help='Publish one message and exit')
    group.add_argument(
        '-t',
        '--times',
        type=positive_int,
        default=0,
        metavar='N',
        help='Publish this number of times and then exit',
    )
    parser.add_argument(
        '-n', '--node-name', type=node_name, help='Name of the created publishing node'
    )


def _add_waiting(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        '-w',
        '--wait-matching-subscriptions',
        type=whole_number,
        metavar='N',
        help='Wait until finding the specified number of matching subscriptions; defaults to 1 '
        'with --once or --times, otherwise to 0',
    )
    parser.add_argument(
        '--max-wait-time-secs',
        type=positive_number,
        metavar='SECONDS',
        help='Give up waiting for matching subscriptions after this time',
    )
    parser.add_argument(
        '--keep-alive',
        metavar='SECONDS',
        type=positive_number,
        default=0.1,
        help='Keep the publishing node alive this long after the last message (default: 0.1)',
    )


def _publish(node: Any, message: OutgoingMessage, args: argparse.Namespace) -> None:
    """
    Publish a message with the count and rate of the options.

    Parameters
    ----------
    node
        The `DirectNode` that publishes; it spins for `keep_alive` s after the last message.
    message
        The message; its time stamps are updated each time.
    args : argparse.Namespace
        The parsed command line of `ros2 topic pub`.

    Raises
    ------
    RuntimeError
        Fewer subscriptions than requested match within `max_wait_time_secs`.

    """
    publication = _Publication(node, message, args)
    publication.wait_for_subscriptions()
    print('publisher: beginning loop')
    publication.publish_all()
    spin_until(node, time.monotonic() + args.keep_alive)


class _Publication:
    """
    Publisher of a message with the rate, count and QoS of the command line.

    Parameters
    ----------
    node
        The `DirectNode` that publishes.
    message
        The message; its time stamps are updated each time.
    args : argparse.Namespace
        The parsed command line of `ros2 topic pub`.

    """

    def __init__(self, node: Any, message: OutgoingMessage, args: argparse.Namespace) -> None:
        from rclpy.event_handler import PublisherEventCallbacks
        from rclpy.qos import QoSPresetProfiles
        from ros2topic.api.qos import copy_profile, Incompatibility, override

        profile = copy_profile(QoSPresetProfiles.get_from_short_key(args.qos_profile or 'default'))
        override(profile, args)
        topic = node.resolve_topic_name(args.topic_name)
        self._node = node
        self._topic = topic
        self._message = message
        self._args = args
        self._incompatibility = Incompatibility(node, topic, profile, publishes=True)
        self._publisher = node.create_publisher(
            type(message.message),
            topic,
            profile,
            event_callbacks=PublisherEventCallbacks(
                incompatible_qos=self._incompatibility.on_event
            ),
        )

    def publish_all(self) -> None:
        """Publish the requested number of times, or endlessly."""
        times = 1 if self._args.once else self._args.times
        count = 0
        next_s = time.monotonic()
        while times == 0 or count < times:
            spin_until(self._node, next_s)
            self._incompatibility.check()
            next_s += 1.0 / self._args.rate
            count += 1
            self._publish_one(count)

    def _publish_one(self, count: int) -> None:
        outgoing = self._message.stamped(self._node.get_clock().now().to_msg())
        if self._args.print and count % self._args.print == 0:
            print(f'publishing #{count}: {outgoing!r}\n')
        self._publisher.publish(outgoing)

    def wait_for_subscriptions(self) -> None:
        """Wait until subscriptions are discovered, plus a moment for them to discover us."""
        wanted = self._args.wait_matching_subscriptions
        if wanted is None:
            wanted = 1 if self._args.once or self._args.times else 0
        start = announced = time.monotonic()
        patience = Patience(f"subscriptions of '{self._topic}'", self._hint)
        while self._publisher.get_subscription_count() < wanted:
            now = time.monotonic()
            self._check_limit(now - start, wanted)
            if now >= announced:
                print(f'Waiting for at least {wanted} matching subscription(s)...')
                announced = now + ANNOUNCE_S
            patience.check()
            self._node.spin_once(PERIOD_S)
            self._incompatibility.check()
        if wanted:
            spin_until(self._node, time.monotonic() + SETTLE_S)

    def _hint(self) -> str:
        graph = self._node.graph
        mismatch = type_mismatch(graph, self._topic, type(self._message.message))
        return mismatch or closest_topic(graph, self._topic)

    def _check_limit(self, waited_s: float, wanted: int) -> None:
        limit_s = self._args.max_wait_time_secs
        if limit_s is not None and waited_s > limit_s:
            raise RuntimeError(
                f'Timed out waiting for subscribers: Expected {wanted} subcribers but only got '
                f'{self._publisher.get_subscription_count()} subscribers'
            )
