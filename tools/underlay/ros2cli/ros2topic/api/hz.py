# SPDX-License-Identifier: Apache-2.0
"""Measure the rate of a topic."""

from __future__ import annotations

import argparse
from typing import Any

from ros2topic.api.rate import RateMeter
from ros2topic.api.reporting import report_for_ever
from ros2topic.api.watching import subscribe_when_published


def print_rate(node: Any, topic: str, args: argparse.Namespace) -> None:
    """
    Print the rate of a topic about once a second, endlessly.

    Parameters
    ----------
    node
        The `DirectNode` that subscribes.
    topic
        Full name of the topic.
    args : argparse.Namespace
        The parsed command line of `ros2 topic hz`.

    Raises
    ------
    RuntimeError
        The topic has several types, or the filter does not fit the messages.

    """
    meter = RateMeter(args.window)
    clock = node.get_clock() if args.use_sim_time and not args.wall_time else None

    def count(message: Any, received_s: float) -> None:
        if not args.filter or args.filter(message):
            meter.add(clock.now().nanoseconds / 1e9 if clock else received_s)

    watched = subscribe_when_published(node, topic, count, raw=not args.filter)
    report_for_ever(node, topic, meter.report, watched)
