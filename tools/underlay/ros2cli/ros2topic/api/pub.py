# SPDX-License-Identifier: Apache-2.0
"""Publish a message at a rate."""

from __future__ import annotations

import argparse
import time
from typing import Any

from rclpy.qos import QoSPresetProfiles
from ros2cli.messages.outgoing import OutgoingMessage
from ros2topic.api.qos import copy_profile, override

ANNOUNCE_S = 1.0
PERIOD_S = 0.02
SETTLE_S = 0.25


def publish(node: Any, message: OutgoingMessage, args: argparse.Namespace) -> None:
    """Wait for subscriptions if need be, then publish until enough is published."""
    profile = copy_profile(QoSPresetProfiles.get_from_short_key(args.qos_profile or 'default'))
    override(profile, args)
    publisher = node.create_publisher(type(message.message), args.topic_name, profile)
    _wait_for_subscriptions(node, publisher, args)
    print('publisher: beginning loop')
    times = 1 if args.once else args.times
    count = 0
    next_s = time.monotonic()
    while times == 0 or count < times:
        _spin_until(node, next_s)
        next_s += 1.0 / args.rate
        count += 1
        _publish_one(node, publisher, message, count, args)
    _spin_until(node, time.monotonic() + args.keep_alive)


def _publish_one(
    node: Any, publisher: Any, message: OutgoingMessage, count: int, args: argparse.Namespace
) -> None:
    outgoing = message.stamped(node.get_clock().now().to_msg())
    if args.print and count % args.print == 0:
        print(f'publishing #{count}: {outgoing!r}\n')
    publisher.publish(outgoing)


def _wait_for_subscriptions(node: Any, publisher: Any, args: argparse.Namespace) -> None:
    """Wait until subscriptions are known, and a moment more until they know us as well."""
    wanted = args.wait_matching_subscriptions
    if wanted is None:
        wanted = 1 if args.once or args.times else 0
    start = announced = time.monotonic()
    while publisher.get_subscription_count() < wanted:
        now = time.monotonic()
        if args.max_wait_time_secs is not None and now - start > args.max_wait_time_secs:
            raise RuntimeError(
                f'Timed out waiting for subscribers: Expected {wanted} subcribers but only got '
                f'{publisher.get_subscription_count()} subscribers'
            )
        if now >= announced:
            print(f'Waiting for at least {wanted} matching subscription(s)...')
            announced = now + ANNOUNCE_S
        node.spin_once(PERIOD_S)
    if wanted:
        _spin_until(node, time.monotonic() + SETTLE_S)


def _spin_until(node: Any, end_s: float) -> None:
    while True:
        left_s = end_s - time.monotonic()
        node.spin_once(max(0.0, left_s))
        if left_s <= 0.0:
            return
