# SPDX-License-Identifier: Apache-2.0
"""Incompatible quality of service: a subscriber that requests more than a publisher offers."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Mapping, Sequence
import sys
from typing import Any

from quality_of_service_demo_py.common_nodes import Listener, PERIOD_S, run_demo, Talker
from rclpy.duration import Duration
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import (
    DurabilityPolicy,
    LivelinessPolicy,
    qos_policy_name_from_kind,
    QoSProfile,
    ReliabilityPolicy,
)
from tf2_ros.executing import sleep

__all__ = ['main', 'make_nodes', 'make_parser']

TOPIC = 'incompatible_qos_chatter'
MESSAGES = 5
LONG, SHORT = Duration(seconds=1.0), Duration(seconds=0.5)
POLICIES: Mapping[str, tuple[str, Any, Any]] = {
    'durability': ('durability', DurabilityPolicy.VOLATILE, DurabilityPolicy.TRANSIENT_LOCAL),
    'deadline': ('deadline', LONG, SHORT),
    'liveliness_policy': (
        'liveliness',
        LivelinessPolicy.AUTOMATIC,
        LivelinessPolicy.MANUAL_BY_TOPIC,
    ),
    'liveliness_lease_duration': ('liveliness_lease_duration', LONG, SHORT),
    'reliability': ('reliability', ReliabilityPolicy.BEST_EFFORT, ReliabilityPolicy.RELIABLE),
}
"""By the name on the command line: the policy, what is offered, and what is requested."""


def make_parser() -> ArgumentParser:
    """Return the parser of the command line."""
    parser = ArgumentParser(prog='incompatible_qos', description=__doc__)
    parser.add_argument(
        'incompatible_qos_policy_name',
        choices=POLICIES,
        help='the policy of which more is requested than offered',
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
    name, offer, request = POLICIES[options.incompatible_qos_policy_name]

    def offered(event: Any) -> None:
        _log(talker, 'Offered', event)

    def requested(event: Any) -> None:
        _log(listener, 'Requested', event)

    talker = Talker(
        TOPIC,
        QoSProfile(depth=10, **{name: offer}),
        PublisherEventCallbacks(incompatible_qos=offered),
        last=MESSAGES,
    )
    listener = Listener(
        TOPIC,
        QoSProfile(depth=10, **{name: request}),
        SubscriptionEventCallbacks(incompatible_qos=requested),
    )
    listener.start_listening()
    return talker, listener


def _log(node: Node, side: str, event: Any) -> None:
    policy = qos_policy_name_from_kind(event.last_policy_kind)
    node.get_logger().info(
        f'{side} incompatible QoS - total {event.total_count} delta {event.total_count_change} '
        f'last policy: {policy}'
    )


async def _wait(_: Namespace, talker: Talker, __: Listener) -> None:
    await sleep(talker, PERIOD_S * (MESSAGES + 1))


def main(argv: Sequence[str] | None = None) -> int:
    """
    Run the demo; return the exit status.

    Parameters
    ----------
    argv : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_demo(make_parser(), make_nodes, argv, _wait, ends=True)


if __name__ == '__main__':
    sys.exit(main())
