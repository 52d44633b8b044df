# SPDX-License-Identifier: Apache-2.0
"""A node that logs messages as they are serialized."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

from rclpy.node import Node
from std_msgs.msg import String
from tf2_ros.program import run_node

__all__ = ['SerializedSubscriber', 'main']


class SerializedSubscriber(Node):
    """
    Logs the bytes of the messages of the topic `chatter`.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('serialized_subscriber', **options)
        self.create_subscription(String, 'chatter', self.listener_callback, 10, raw=True)

    def listener_callback(self, msg: bytes) -> None:
        """
        Log a message.

        Parameters
        ----------
        msg
            The message in the encoding of DDS: CDR.

        """
        self.get_logger().info(f'I heard: "{msg!r}"')


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: SerializedSubscriber(), args)


if __name__ == '__main__':
    sys.exit(main())
