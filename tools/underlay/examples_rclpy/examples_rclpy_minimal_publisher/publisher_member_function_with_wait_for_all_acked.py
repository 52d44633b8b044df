# SPDX-License-Identifier: Apache-2.0
"""A publisher that, at its end, waits until all subscribers have acknowledged its messages."""

from __future__ import annotations

from collections.abc import Sequence
import sys

from examples_rclpy_minimal_publisher.publisher_member_function import MinimalPublisher
from rclpy.duration import Duration
from tf2_ros.program import run, spin

__all__ = ['main']

PATIENCE_S = 3


def _work(_: list[str]) -> None:
    node = MinimalPublisher()
    spin(node)
    if node.publisher_.wait_for_all_acked(Duration(seconds=PATIENCE_S)):
        node.get_logger().info('All subscribers acknowledged messages.')
    else:
        node.get_logger().info(
            f'Not all subscribers acknowledged messages during {PATIENCE_S} seconds.'
        )
    node.destroy_node()


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run(list, _work, args)


if __name__ == '__main__':
    sys.exit(main())
