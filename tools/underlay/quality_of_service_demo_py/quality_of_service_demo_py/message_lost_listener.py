# SPDX-License-Identifier: Apache-2.0
"""A listener that tells how many messages were lost."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.time import Time
from sensor_msgs.msg import Image
from tf2_ros.program import run_node

__all__ = ['QOS', 'TOPIC', 'MessageLostListener', 'main']

TOPIC = 'message_lost_chatter'
QOS = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)


class MessageLostListener(Node):
    """
    Logs how long each image was under way, and how many were lost.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('MessageLostListener', **options)
        events = SubscriptionEventCallbacks(message_lost=self.log_lost)
        self.create_subscription(Image, TOPIC, self.listen, QOS, event_callbacks=events)

    def listen(self, image: Image) -> None:
        """
        Log how long an image was under way.

        Parameters
        ----------
        image
            The image.

        """
        latency = self.get_clock().now() - Time.from_msg(image.header.stamp)
        self.get_logger().info(
            f'I heard an image. Message single trip latency: [{latency.nanoseconds / 1e9:.6f}]'
        )

    def log_lost(self, event: Any) -> None:
        """
        Log how many images were lost.

        Parameters
        ----------
        event
            The numbers.

        """
        self.get_logger().info(
            'Some messages were lost:\n'
            f'>\tNumber of new lost messages: {event.total_count_change}\n'
            f'>\tTotal number of messages lost: {event.total_count}'
        )


def main(argv: Sequence[str] | None = None) -> int:
    """
    Run the demo; return the exit status.

    Parameters
    ----------
    argv : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: MessageLostListener(), argv)


if __name__ == '__main__':
    sys.exit(main())
