# SPDX-License-Identifier: Apache-2.0
"""The deadline: how long it may take until the next message."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
import sys
from typing import Any

from quality_of_service_demo_py.common_nodes import Listener, milliseconds, run_demo, Talker
from rclpy.duration import Duration
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import QoSProfile
from tf2_ros.executing import sleep

__all__ = ['main', 'make_nodes', 'make_parser', 'pause_again_and_again']

TOPIC = 'qos_deadline_chatter'


def make_parser() -> ArgumentParser:
    """Return the parser of the command line."""
    parser = ArgumentParser(prog='deadline', description=__doc__)
    parser.add_argument(
        'deadline_duration', type=milliseconds, help='the deadline in ms; 0 is none'
    )
    parser.add_argument(
        '--publish-for',
        type=milliseconds,
        default='5000',
        metavar='MS',
        help='how long the talker publishes between pauses (default: 5000)',
    )
    parser.add_argument(
        '--pause-for',
        type=milliseconds,
        default='1000',
        metavar='MS',
        help='how long it pauses; 0 is not at all (default: 1000)',
    )
    return parser


def make_nodes(options: Namespace) -> tuple[Talker, Listener]:
    """
    Make the talker and the listener.

    Parameters
    ----------
    options
        The parsed command line.

    """
    qos = QoSProfile(depth=10, deadline=Duration(seconds=options.deadline_duration))

    def offered(event: Any) -> None:
        _log(talker, 'Offered', event)

    def requested(event: Any) -> None:
        _log(listener, 'Requested', event)

    talker = Talker(TOPIC, qos, PublisherEventCallbacks(deadline=offered))
    listener = Listener(TOPIC, qos, SubscriptionEventCallbacks(deadline=requested))
    listener.start_listening()
    return talker, listener


def _log(node: Node, side: str, event: Any) -> None:
    node.get_logger().info(
        f'{side} deadline missed - total {event.total_count} delta {event.total_count_change}'
    )


async def pause_again_and_again(options: Namespace, talker: Talker, listener: Listener) -> None:
    """
    Let the talker pause, for ever.

    Parameters
    ----------
    options
        The parsed command line.
    talker
        The talker.
    listener
        The listener, to which nothing is done.

    """
    while options.pause_for:
        await sleep(talker, options.publish_for)
        talker.get_logger().info('Pausing')
        talker.stop()
        await sleep(talker, options.pause_for)
        talker.go_on()


def main(argv: Sequence[str] | None = None) -> int:
    """
    Run the demo; return the exit status.

    Parameters
    ----------
    argv : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_demo(make_parser(), make_nodes, argv, pause_again_and_again)


if __name__ == '__main__':
    sys.exit(main())
