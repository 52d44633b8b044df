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
    """Make the node from its arguments: none, or the file of a URDF."""
    from joint_state_publisher_gui.joint_state_publisher_gui import JointStatePublisherGui, PROGRAM
    from robot_state_publisher.description_file import file_argument

    return JointStatePublisherGui(file_argument(PROGRAM, words))


def main(args: Sequence[str] | None = None) -> None:
    """
    Run joint_state_publisher_gui; exit with its status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line with the program's name; by default that of the process.

    """
    sys.exit(run_node(_make_node, args))


if __name__ == '__main__':
    main()
