# SPDX-License-Identifier: Apache-2.0
"""The options of `ros2 topic pub`."""

from __future__ import annotations

import argparse

from ros2cli.argument_types import node_name, positive_int, positive_number, whole_number
from ros2cli.messages.values_arguments import add_values_arguments


def add_pub_arguments(parser: argparse.ArgumentParser) -> None:
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
