# SPDX-License-Identifier: Apache-2.0
"""A subscriber without a class: a lambda is called for each message."""

from __future__ import annotations

from collections.abc import Sequence
import sys

from rclpy.node import Node
from std_msgs.msg import String
from tf2_ros.program import run_node

__all__ = ['main']


def _make_node(_: list[str]) -> Node:
    node = Node('minimal_subscriber')
    node.create_subscription(
        String, 'topic', lambda msg: node.get_logger().info(f'I heard: "{msg.data}"'), 10
    )
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
