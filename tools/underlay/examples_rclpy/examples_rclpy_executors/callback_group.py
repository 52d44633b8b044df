# SPDX-License-Identifier: Apache-2.0
"""Two timers in a group whose callbacks never run at the same time, though there are threads."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

from examples_rclpy_executors.listener import Listener
from examples_rclpy_executors.program import run_executor
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import Executor, MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String

__all__ = ['DoubleTalker', 'main']

THREADS = 4
PERIODS_S = (1.0, 0.5)


class DoubleTalker(Node):
    """
    Publishes on `chatter` from two timers of one group.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('double_talker', **options)
        self._number = 0
        self._publisher = self.create_publisher(String, 'chatter', 10)
        self.group = MutuallyExclusiveCallbackGroup()
        for period_s in PERIODS_S:
            self.create_timer(period_s, self.timer_callback, callback_group=self.group)

    def timer_callback(self) -> None:
        """Publish the next message; the group protects the number from other threads."""
        message = String(data=f'Hello World: {self._number}')
        self._number += 1
        self.get_logger().info(f'Publishing: "{message.data}"')
        self._publisher.publish(message)


def _make_executor() -> Executor:
    executor = MultiThreadedExecutor(num_threads=THREADS)
    executor.add_node(DoubleTalker())
    executor.add_node(Listener())
    return executor


def main(args: Sequence[str] | None = None) -> int:
    """
    Run both nodes; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_executor(_make_executor, args)


if __name__ == '__main__':
    sys.exit(main())
