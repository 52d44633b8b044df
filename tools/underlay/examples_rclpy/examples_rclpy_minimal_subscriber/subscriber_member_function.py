# SPDX-License-Identifier: Apache-2.0
"""A subscriber that is a class, with a member function for messages."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

from rclpy.node import Node
from std_msgs.msg import String
from tf2_ros.program import run_node

__all__ = ['MinimalSubscriber', 'main']


class MinimalSubscriber(Node):
    """
    Logs what it hears on the topic `topic`.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('minimal_subscriber', **options)
        self.subscription = self.create_subscription(String, 'topic', self.listener_callback, 10)

    def listener_callback(self, msg: String) -> None:
        """
        Log a message.

        Parameters
        ----------
        msg
            The message.

        """
        self.get_logger().info(f'I heard: "{msg.data}"')


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: MinimalSubscriber(), args)


if __name__ == '__main__':
    sys.exit(main())
