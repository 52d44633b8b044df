# SPDX-License-Identifier: Apache-2.0
"""Warn about nodes with `use_sim_time` that receive no time on `/clock`."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rclpy.node import Node

_PATIENCE_S = 5.0
_TOPIC = '/clock'


def watch_clock(node: Node) -> None:
    """
    Warn after 5 s if a node with `use_sim_time` has received no time on `/clock`.

    Parameters
    ----------
    node
        The node whose clock is checked; a timer is added to it if it follows `/clock`.

    """
    if not node.get_clock().ros_time_is_active:
        return
    from rclpy.clock import Clock, ClockType

    def look() -> None:
        timer.cancel()
        if node.get_clock().now().nanoseconds == 0:
            node.get_logger().warning(_complaint(node.count_publishers(_TOPIC)))

    timer = node.create_timer(_PATIENCE_S, look, clock=Clock(clock_type=ClockType.STEADY_TIME))


def _complaint(publishers: int) -> str:
    why = f'no time has come on {_TOPIC} so far' if publishers else f'nobody publishes {_TOPIC}'
    return (
        f'use_sim_time is true, but {why}: the time of this node stands still. Start the '
        'simulator, or play the bag with --clock; without one, leave out use_sim_time.'
    )
