# SPDX-License-Identifier: Apache-2.0
"""A publisher that is a class, whose timer calls a member function."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

from rclpy.node import Node
from std_msgs.msg import String
from tf2_ros.program import run_node

__all__ = ['MinimalPublisher', 'main']

PERIOD_S = 0.5


class MinimalPublisher(Node):
    """
    Publishes `Hello World: N` on the topic `topic` twice per second.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('minimal_publisher', **options)
        self.publisher_ = self.create_publisher(String, 'topic', 10)
        self.create_timer(PERIOD_S, self.timer_callback)
        self._number = 0

    def timer_callback(self) -> None:
        """Publish the next message."""
        message = String(data=f'Hello World: {self._number}')
        self.publisher_.publish(message)
        self.get_logger().info(f'Publishing: "{message.data}"')
        self._number += 1


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: MinimalPublisher(), args)


if __name__ == '__main__':
    sys.exit(main())
