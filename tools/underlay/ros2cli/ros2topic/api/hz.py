# SPDX-License-Identifier: Apache-2.0
"""Measure the rate of a topic."""

from __future__ import annotations

import argparse
import time
from typing import Any

from ros2topic.api.rate import RateMeter
from ros2topic.api.reporting import report_for_ever
from ros2topic.api.watching import subscribe_when_published


def print_rate(node: Any, topic: str, args: argparse.Namespace) -> None:
    """Print the rate of a topic about once a second, for ever."""
    meter = RateMeter(args.window)
    clock = node.get_clock() if args.use_sim_time and not args.wall_time else None

    def count(_: Any) -> None:
        meter.add(clock.now().nanoseconds / 1e9 if clock else time.monotonic())

    def count_accepted(message: Any) -> None:
        if args.filter(message):
            count(message)

    callback = count_accepted if args.filter else count
    watched = subscribe_when_published(node, topic, callback, raw=not args.filter)
    report_for_ever(node, topic, meter.report, watched)
