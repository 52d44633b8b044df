# SPDX-License-Identifier: Apache-2.0
"""Entry point; imports the node only once signals are deferred, so that Ctrl-C raises no error."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import TYPE_CHECKING

from tf2_ros.program import run_node

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['main']


def _make_node(words: list[str]) -> Node:
    """Create the node from its arguments: none, or a URDF file (deprecated)."""
    from robot_state_publisher.node_arguments import file_argument
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
        The command line including the program name; by default that of the process.

    """
    sys.exit(run_node(_make_node, args))


if __name__ == '__main__':
    main()
