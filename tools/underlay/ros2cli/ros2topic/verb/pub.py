# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 topic pub`."""

from __future__ import annotations

import argparse

from ros2cli.arguments import (
    add_node_arguments,
    node_name,
    positive_int,
    positive_number,
    whole_number,
)
from ros2cli.messages.values import add_values_arguments, values_text
from ros2topic.api.arguments import add_qos_arguments
from ros2topic.verb import VerbExtension

PRIVATE = '~'


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
        from ros2cli.messages.lookup import get_passed_type
        from ros2cli.messages.outgoing import OutgoingMessage
        from ros2cli.names import absolute
        from ros2cli.node.direct import DirectNode
        from ros2topic.api.pub import publish

        message_type = get_passed_type(args.message_type, 'msg')
        if args.topic_name != PRIVATE:
            absolute(args.topic_name.removeprefix(PRIVATE))
        message = OutgoingMessage(message_type(), values_text(args))
        with DirectNode(args, node_name=args.node_name) as node:
            publish(node, message, args)
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
