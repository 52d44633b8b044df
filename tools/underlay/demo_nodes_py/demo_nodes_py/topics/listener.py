# SPDX-License-Identifier: Apache-2.0
"""A node that logs the texts that it receives."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

from rclpy.node import Node
from rclpy.qos import QoSProfile
from std_msgs.msg import String
from tf2_ros.program import run_node

__all__ = ['Listener', 'main']


class Listener(Node):
    """
    Logs the messages of the topic `chatter`.

    Parameters
    ----------
    name
        The name of the node.
    qos
        The QoS of the subscription, or the depth of its history.
    options
        Further keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, name: str = 'listener', qos: QoSProfile | int = 10, **options: Any) -> None:
        super().__init__(name, **options)
        self.create_subscription(String, 'chatter', self.chatter_callback, qos)

    def chatter_callback(self, msg: String) -> None:
        """
        Log a message.

        Parameters
        ----------
        msg
            The message.

        """
        self.get_logger().info(f'I heard: [{msg.data}]')


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: Listener(), args)


if __name__ == '__main__':
    sys.exit(main())
