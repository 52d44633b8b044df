# SPDX-License-Identifier: Apache-2.0
"""The lifespan: how long a message is kept for subscribers that come late."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
import sys

from quality_of_service_demo_py.common_nodes import Listener, milliseconds, run_demo, Talker
from rclpy.duration import Duration
from rclpy.qos import DurabilityPolicy, QoSProfile

__all__ = ['main', 'make_nodes', 'make_parser']

TOPIC = 'qos_lifespan_chatter'


def make_parser() -> ArgumentParser:
    """Return the parser of the command line."""
    parser = ArgumentParser(prog='lifespan', description=__doc__)
    parser.add_argument(
        'lifespan_duration', type=milliseconds, help='the lifespan in ms; 0 is for ever'
    )
    parser.add_argument(
        '--history',
        type=int,
        default=10,
        metavar='N',
        help='how many messages are kept (default: 10)',
    )
    parser.add_argument(
        '--publish-count',
        type=int,
        default=10,
        metavar='N',
        help='how many messages the talker publishes (default: 10)',
    )
    parser.add_argument(
        '--subscribe-after',
        type=milliseconds,
        default='3000',
        metavar='MS',
        help='when the listener subscribes (default: 3000)',
    )
    return parser


def make_nodes(options: Namespace) -> tuple[Talker, Listener]:
    """
    Make the talker, and the listener, which does not listen yet.

    Parameters
    ----------
    options
        The parsed command line.

    """
    qos = QoSProfile(
        depth=options.history,
        durability=DurabilityPolicy.TRANSIENT_LOCAL,
        lifespan=Duration(seconds=options.lifespan_duration),
    )
    return Talker(TOPIC, qos, last=options.publish_count), Listener(TOPIC, qos)


async def _listen_late(options: Namespace, _: Talker, listener: Listener) -> None:
    await listener.start_listening_after(options.subscribe_after)


def main(argv: Sequence[str] | None = None) -> int:
    """
    Run the demo; return the exit status.

    Parameters
    ----------
    argv : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_demo(make_parser(), make_nodes, argv, _listen_late)


if __name__ == '__main__':
    sys.exit(main())
