# SPDX-License-Identifier: Apache-2.0
"""Print the messages of a topic as they come."""

from __future__ import annotations

import argparse
import time
from typing import Any

from rclpy.event_handler import SubscriptionEventCallbacks
from ros2cli.patience import Patience
from ros2topic.api.printing import printer
from ros2topic.api.qos import choose_qos
from ros2topic.api.waiting import settled_publishers

PERIOD_S = 0.1


def echo(node: Any, topic: str, message_type: Any, args: argparse.Namespace) -> None:
    """Print messages until one has come, if that is enough, or until the time is over."""
    end = time.monotonic() + (args.timeout if args.timeout is not None else float('inf'))
    listener = Listener(node, topic, message_type, args)
    patience = Patience(f"a message on '{topic}'")
    while time.monotonic() < end and not (args.once and listener.count):
        node.spin_once(min(PERIOD_S, max(0.0, end - time.monotonic())))
        if not listener.count:
            patience.check()


class Listener:
    """A subscription that prints what it receives."""

    def __init__(self, node: Any, topic: str, message_type: Any, args: argparse.Namespace) -> None:
        """Subscribe with the quality of service that the publishers offer."""
        profile, notices = choose_qos(args, settled_publishers(node, topic))
        for notice in notices:
            print(notice)
        self.count = 0
        self._once = args.once
        self._print = printer(args)
        events = SubscriptionEventCallbacks(
            message_lost=None if args.no_lost_messages else _report_lost
        )
        self._subscription = node.create_subscription(
            message_type, topic, self._receive, profile, event_callbacks=events, raw=args.raw
        )

    def _receive(self, message: Any, info: Any) -> None:
        if not (self._once and self.count):
            self.count += 1
            self._print(message, info)


def _report_lost(status: Any) -> None:
    print(
        'A message was lost!!!\n'
        f'\ttotal count change:{status.total_count_change}\n'
        f'\ttotal count: {status.total_count}',
        end='---\n',
    )
