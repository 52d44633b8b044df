# SPDX-License-Identifier: Apache-2.0
"""Tests of a node whose callbacks may fail."""

from typing import Any

from domain_coordinator import domain_id
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rviz_common.guarded_node import GuardedNode
from std_msgs.msg import String


def test_a_callback_that_fails_does_not_end_the_node(capfd: Any) -> None:
    """Messages and timers go on, and the log names the topic and the reason."""
    context, got = rclpy.Context(), []

    def fail(message: String) -> None:
        got.append(message.data)
        raise RuntimeError('no message')

    with domain_id() as domain:
        rclpy.init(context=context, domain_id=domain)
        try:
            node = GuardedNode('test', context=context)
            node.create_subscription(String, 'talk', fail, 10)
            publisher = node.create_publisher(String, 'talk', 10)
            node.create_timer(0.05, lambda: publisher.publish(String(data='x')))
            node.create_timer(0.05, lambda: 1 // 0)
            executor = SingleThreadedExecutor(context=context)
            executor.add_node(node)
            for _ in range(600):
                executor.spin_once(timeout_sec=0.1)
                if len(got) >= 3:
                    break
            executor.shutdown()
            node.destroy_node()
        finally:
            context.try_shutdown()
    assert len(got) >= 3
    said = capfd.readouterr().err
    assert "The callback of 'talk' has raised an error: " in said
    assert 'RuntimeError: no message' in said
    assert 'ZeroDivisionError' in said
