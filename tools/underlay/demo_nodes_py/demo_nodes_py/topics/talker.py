# SPDX-License-Identifier: Apache-2.0
"""A node that publishes a text with a number once per second."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

from rclpy.node import Node
from rclpy.qos import QoSProfile
from std_msgs.msg import String
from tf2_ros.program import run_node

__all__ = ['Talker', 'main']


class Talker(Node):
    """
    Publishes `Hello World: N` on the topic `chatter` once per second.

    Parameters
    ----------
    name
        The name of the node.
    qos
        The QoS of the publisher, or the depth of its history.
    first
        The number in the first message.
    quote
        The quotation mark around the text in the log.
    options
        Further keyword arguments of `rclpy.node.Node`.

    """

    def __init__(
        self,
        name: str = 'talker',
        qos: QoSProfile | int = 10,
        *,
        first: int = 0,
        quote: str = '"',
        **options: Any,
    ) -> None:
        super().__init__(name, **options)
        self._number = first
        self._quote = quote
        self._publisher = self.create_publisher(String, 'chatter', qos)
        self.create_timer(1.0, self.timer_callback)

    def timer_callback(self) -> None:
        """Publish the next message."""
        message = String(data=f'Hello World: {self._number}')
        self._number += 1
        self.get_logger().info(f'Publishing: {self._quote}{message.data}{self._quote}')
        self._publisher.publish(message)


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: Talker(), args)


if __name__ == '__main__':
    sys.exit(main())
