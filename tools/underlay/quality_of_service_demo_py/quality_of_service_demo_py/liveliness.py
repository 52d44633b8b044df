# SPDX-License-Identifier: Apache-2.0
"""Liveliness: how long a publisher counts as alive without a sign of life."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
import sys
from typing import Any

from quality_of_service_demo_py.common_nodes import Listener, milliseconds, run_demo, Talker
from rclpy.duration import Duration
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.qos import LivelinessPolicy, QoSProfile
from tf2_ros.executing import sleep

__all__ = ['kill_talker', 'main', 'make_nodes', 'make_parser']

TOPIC = 'qos_liveliness_chatter'


def make_parser() -> ArgumentParser:
    """Return the parser of the command line."""
    parser = ArgumentParser(prog='liveliness', description=__doc__)
    parser.add_argument(
        'lease_duration',
        type=milliseconds,
        help='how often a sign of life is due, in ms; 0 is never',
    )
    parser.add_argument(
        '--policy',
        choices=('AUTOMATIC', 'MANUAL_BY_TOPIC'),
        default='AUTOMATIC',
        help='who gives the signs: the middleware, or the talker by its messages and by asserting '
        'its liveliness (default: AUTOMATIC)',
    )
    parser.add_argument(
        '--topic-assert-period',
        type=milliseconds,
        default='0',
        metavar='MS',
        help='how often the talker asserts its liveliness; 0 is never (default: 0)',
    )
    parser.add_argument(
        '--publish-period',
        type=milliseconds,
        default='500',
        metavar='MS',
        help='how often the talker publishes; 0 is never (default: 500)',
    )
    parser.add_argument(
        '--kill-publisher-after',
        type=milliseconds,
        default='3000',
        metavar='MS',
        help='when its publisher is destroyed or, with MANUAL_BY_TOPIC, falls silent; 0 is never '
        '(default: 3000)',
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
    qos = QoSProfile(
        depth=10,
        liveliness=LivelinessPolicy[options.policy],
        liveliness_lease_duration=Duration(seconds=options.lease_duration),
    )

    def lost(event: Any) -> None:
        talker.get_logger().info(
            f'Liveliness lost - total {event.total_count} delta {event.total_count_change}'
        )

    def changed(event: Any) -> None:
        listener.get_logger().info(
            f'Liveliness changed - alive {event.alive_count} (delta {event.alive_count_change}), '
            f'not alive {event.not_alive_count} (delta {event.not_alive_count_change})'
        )

    talker = Talker(
        TOPIC,
        qos,
        PublisherEventCallbacks(liveliness=lost),
        period_s=options.publish_period or 1.0,
    )
    if not options.publish_period:
        talker.stop()
    listener = Listener(TOPIC, qos, SubscriptionEventCallbacks(liveliness=changed))
    listener.start_listening()
    return talker, listener


async def kill_talker(options: Namespace, talker: Talker, listener: Listener) -> None:
    """
    Let the talker assert its liveliness, and after some time end all signs of life.

    Parameters
    ----------
    options
        The parsed command line.
    talker
        The talker.
    listener
        The listener, to which nothing is done.

    """
    assertions = None
    if options.topic_assert_period:
        assertions = talker.create_timer(
            options.topic_assert_period, talker.publisher.assert_liveliness
        )
    if not options.kill_publisher_after:
        return
    await sleep(talker, options.kill_publisher_after)
    talker.stop()
    if assertions is not None:
        talker.destroy_timer(assertions)
    if options.policy == 'AUTOMATIC':
        # The middleware gives signs of life for as long as there is a publisher.
        talker.get_logger().info('Destroying the publisher')
        talker.destroy_publisher(talker.publisher)
    else:
        talker.get_logger().info('Stopping')


def main(argv: Sequence[str] | None = None) -> int:
    """
    Run the demo; return the exit status.

    Parameters
    ----------
    argv : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_demo(make_parser(), make_nodes, argv, kill_talker)


if __name__ == '__main__':
    sys.exit(main())
