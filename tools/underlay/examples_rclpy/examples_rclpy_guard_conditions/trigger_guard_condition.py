# SPDX-License-Identifier: Apache-2.0
"""A guard condition, by which another thread makes the executor call a function."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from threading import Timer

from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future
from tf2_ros.program import run

__all__ = ['main', 'wait_for_trigger']

DELAY_S = 1.0


def wait_for_trigger(node: Node, delay_s: float = DELAY_S) -> None:
    """
    Let a thread trigger a guard condition, and spin until its callback was called.

    Parameters
    ----------
    node
        The node that gets the guard condition.
    delay_s
        The time until the thread triggers it, in s.

    """
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    end: Future[None] = Future(executor=executor)

    def guard_callback() -> None:
        node.get_logger().info('Guard callback called!')
        end.set_result(None)

    condition = node.create_guard_condition(guard_callback)
    node.get_logger().info('Waiting for the guard condition...')
    Timer(delay_s, condition.trigger).start()
    executor.spin_until_future_complete(end)
    executor.shutdown()
    node.destroy_guard_condition(condition)


def _work(_: list[str]) -> None:
    node = Node('guard_condition')
    wait_for_trigger(node)
    node.destroy_node()


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run(list, _work, args)


if __name__ == '__main__':
    sys.exit(main())
