# SPDX-License-Identifier: Apache-2.0
"""The program; it imports the node only when signals can wait, so that none is an error."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import TYPE_CHECKING

from tf2_ros.program import run_node

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['main']


def _make_node(words: list[str]) -> Node:
    """Make the node from its arguments: none, or the file of a URDF, as was once usual."""
    from robot_state_publisher.description_file import file_argument
    from robot_state_publisher.robot_state_publisher import RobotStatePublisher

    file = file_argument('robot_state_publisher', words)
    node = RobotStatePublisher(file)
    if file is not None:
        node.get_logger().warning(
            'A URDF as argument is deprecated: pass its text as the parameter robot_description.'
        )
    return node


def main(args: Sequence[str] | None = None) -> None:
    """
    Run robot_state_publisher; exit with its status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line with the program's name; by default that of the process.

    """
    sys.exit(run_node(_make_node, args))


if __name__ == '__main__':
    main()
