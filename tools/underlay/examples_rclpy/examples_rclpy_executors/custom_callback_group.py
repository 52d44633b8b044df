# SPDX-License-Identifier: Apache-2.0
"""A callback group of its own that limits how often callbacks run, by tokens."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from threading import Lock
from typing import Any

from examples_rclpy_executors.program import run_executor
from rclpy.callback_groups import CallbackGroup
from rclpy.executors import Executor, SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String

__all__ = ['ThrottledCallbackGroup', 'ThrottledTalker', 'main']

TOKENS_AT_MOST = 10
REFILL_S = 0.5
PERIOD_S = 0.2


class ThrottledCallbackGroup(CallbackGroup):
    """
    Callback group whose callbacks each need a token: there is a new one every half second.

    Parameters
    ----------
    node
        The node whose timer makes the tokens, in its default group.

    """

    def __init__(self, node: Node) -> None:
        super().__init__()
        self.lock = Lock()
        self.bucket = TOKENS_AT_MOST
        node.create_timer(REFILL_S, self.timer_callback)

    def can_execute(self, entity: Any) -> bool:
        """
        Whether there is a token.

        Parameters
        ----------
        entity
            A timer, subscription, client or service of the group.

        """
        with self.lock:
            return self.bucket > 0

    def beginning_execution(self, entity: Any) -> bool:
        """
        Take a token if there is one; return whether the callback may run.

        Parameters
        ----------
        entity
            A timer, subscription, client or service of the group.

        """
        with self.lock:
            if self.bucket == 0:
                return False
            self.bucket -= 1
            return True

    def ending_execution(self, entity: Any) -> None:
        """
        Do nothing: tokens are not given back.

        Parameters
        ----------
        entity
            A timer, subscription, client or service of the group.

        """

    def timer_callback(self) -> None:
        """Add a token, up to the most that the group may have."""
        with self.lock:
            self.bucket = min(self.bucket + 1, TOKENS_AT_MOST)


class ThrottledTalker(Node):
    """
    Publishes on `chatter` five times per second, until its group slows it down.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('throttled_talker', **options)
        self._number = 0
        self._publisher = self.create_publisher(String, 'chatter', 10)
        self.group = ThrottledCallbackGroup(self)
        self.create_timer(PERIOD_S, self.timer_callback, callback_group=self.group)

    def timer_callback(self) -> None:
        """Publish the next message."""
        message = String(data=f'Hello World: {self._number}')
        self._number += 1
        self.get_logger().info(f'Publishing: "{message.data}"')
        self._publisher.publish(message)


def _make_executor() -> Executor:
    executor = SingleThreadedExecutor()
    executor.add_node(ThrottledTalker())
    return executor


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_executor(_make_executor, args)


if __name__ == '__main__':
    sys.exit(main())
