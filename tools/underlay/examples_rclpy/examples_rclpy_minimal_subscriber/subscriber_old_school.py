# SPDX-License-Identifier: Apache-2.0
"""A subscriber without a class: a function of the module is called with each message."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
import sys

from rclpy.node import Node
from std_msgs.msg import String
from tf2_ros.program import run_node

__all__ = ['chatter_callback', 'main']


def chatter_callback(node: Node, msg: String) -> None:
    """
    Log a message.

    Parameters
    ----------
    node
        The node that has subscribed.
    msg
        The message.

    """
    node.get_logger().info(f'I heard: "{msg.data}"')


def _make_node(_: list[str]) -> Node:
    node = Node('minimal_subscriber')
    node.create_subscription(String, 'topic', partial(chatter_callback, node), 10)
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
