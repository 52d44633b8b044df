# SPDX-License-Identifier: Apache-2.0
"""The executor of the environment's programs."""

from __future__ import annotations

from rclpy.clock import Clock, ClockType
from rclpy.context import Context
from rclpy.node import Node
from rclpy.task import Future
from tf2_ros.executing import make_executor, spin_until


def test_a_timer_that_was_called_too_often_is_restarted() -> None:
    """Each call puts the next one off by a period, here to more than a minute from now."""
    context = Context()
    context.init()
    node = Node('hurried', context=context)
    executor = make_executor(context)
    executor.add_node(node)
    end: Future[None] = Future()
    limit, clock = (Clock(clock_type=ClockType.STEADY_TIME) for _ in range(2))
    node.create_timer(10.0, lambda: end.set_exception(TimeoutError()), clock=limit)
    timer = node.create_timer(0.05, lambda: end.set_result(None), clock=clock)
    for _ in range(1500):
        timer.handle.call_timer()
    assert timer.time_until_next_call() > 60e9
    spin_until(executor, end, context)
    assert end.exception() is None
    node.destroy_node()
    context.try_shutdown()
