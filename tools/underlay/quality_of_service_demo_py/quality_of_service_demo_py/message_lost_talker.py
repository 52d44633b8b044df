# SPDX-License-Identifier: Apache-2.0
"""A talker whose images are so large that some may be lost."""

from __future__ import annotations

from argparse import ArgumentParser
from collections.abc import Sequence
import sys
from typing import Any

from quality_of_service_demo_py.common_nodes import run_demo
from quality_of_service_demo_py.message_lost_listener import QOS, TOPIC
from rclpy.node import Node
from sensor_msgs.msg import Image
from tf2_ros.program import number_in

__all__ = ['MessageLostTalker', 'main', 'make_parser']

PERIOD_S = 3.0
KIB = 1024
SMALLEST_KIB, DEFAULT_KIB, LARGEST_KIB = 1, 8192, 1 << 20


class MessageLostTalker(Node):
    """
    Publishes an image every three seconds.

    Parameters
    ----------
    size_kib
        The size of an image, in KiB.
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, size_kib: int = DEFAULT_KIB, **options: Any) -> None:
        super().__init__('message_lost_talker', **options)
        self._image = Image(
            height=size_kib, width=KIB, step=KIB, encoding='mono8', data=bytes(size_kib * KIB)
        )
        self._publisher = self.create_publisher(Image, TOPIC, QOS)
        self.create_timer(PERIOD_S, self.publish)

    def publish(self) -> None:
        """Publish the image with the time."""
        now = self.get_clock().now()
        self._image.header.stamp = now.to_msg()
        self.get_logger().info(f'Publishing an image, sent at [{now.nanoseconds / 1e9:.6f}]')
        self._publisher.publish(self._image)


def make_parser() -> ArgumentParser:
    """Return the parser of the command line."""
    parser = ArgumentParser(prog='message_lost_talker', description=__doc__)
    parser.add_argument(
        '-s',
        '--size',
        type=number_in(SMALLEST_KIB, LARGEST_KIB, 'size in KiB'),
        default=DEFAULT_KIB,
        metavar='KIB',
        help=f'the size of an image in KiB (default: {DEFAULT_KIB})',
    )
    return parser


def main(argv: Sequence[str] | None = None) -> int:
    """
    Run the demo; return the exit status.

    Parameters
    ----------
    argv : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_demo(make_parser(), lambda options: [MessageLostTalker(round(options.size))], argv)


if __name__ == '__main__':
    sys.exit(main())
