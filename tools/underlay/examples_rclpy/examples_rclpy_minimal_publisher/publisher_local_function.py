# SPDX-License-Identifier: Apache-2.0
"""A publisher without a class: its timer calls a local function."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import count
import sys

from rclpy.node import Node
from std_msgs.msg import String
from tf2_ros.program import run_node

__all__ = ['main']

PERIOD_S = 0.5


def _make_node(_: list[str]) -> Node:
    node = Node('minimal_publisher')
    publisher = node.create_publisher(String, 'topic', 10)
    numbers = count()

    def publish() -> None:
        message = String(data=f'Hello World: {next(numbers)}')
        node.get_logger().info(f'Publishing: "{message.data}"')
        publisher.publish(message)

    node.create_timer(PERIOD_S, publish)
    return node


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(_make_node, args)


if __name__ == '__main__':
    sys.exit(main())
