# SPDX-License-Identifier: Apache-2.0
"""Warn when a node waits for simulated time that does not come."""

from __future__ import annotations

from rclpy.clock import Clock, ClockType
from rclpy.node import Node

PATIENCE_S = 5.0
TOPIC = '/clock'


def watch_clock(node: Node) -> None:
    """
    Warn once if a node with `use_sim_time` receives no time from /clock.

    Parameters
    ----------
    node
        The node; it is checked once, `PATIENCE_S` of real time from now.

    """
    if not node.get_clock().ros_time_is_active:
        return

    def look() -> None:
        timer.cancel()
        if node.get_clock().now().nanoseconds == 0:
            node.get_logger().warning(complaint(node.count_publishers(TOPIC)))

    timer = node.create_timer(PATIENCE_S, look, clock=Clock(clock_type=ClockType.STEADY_TIME))


def complaint(publishers: int) -> str:
    """
    Build the warning about missing simulated time.

    Parameters
    ----------
    publishers
        Number of publishers of /clock.

    """
    why = f'no time has come on {TOPIC} so far' if publishers else f'nobody publishes {TOPIC}'
    return (
        f'use_sim_time is true, but {why}: the time of this node stands still. Start the '
        'simulator, or play the bag with --clock; without one, leave out use_sim_time.'
    )
