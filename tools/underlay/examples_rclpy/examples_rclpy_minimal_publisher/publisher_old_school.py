# SPDX-License-Identifier: Apache-2.0
"""A publisher with a loop that publishes and sleeps, instead of a timer."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import count
import sys

from rclpy.node import Node
from std_msgs.msg import String
from tf2_ros.executing import sleep
from tf2_ros.program import run_node

__all__ = ['main']

PERIOD_S = 0.5


async def _publish(node: Node) -> None:
    publisher = node.create_publisher(String, 'topic', 10)
    for number in count():
        message = String(data=f'Hello World: {number}')
        node.get_logger().info(f'Publishing: "{message.data}"')
        publisher.publish(message)
        await sleep(node, PERIOD_S)


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: Node('minimal_publisher'), args, _publish)


if __name__ == '__main__':
    sys.exit(main())
