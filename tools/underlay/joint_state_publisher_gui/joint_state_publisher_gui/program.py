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
    """Create the node from its arguments: none, or a URDF file."""
    from joint_state_publisher_gui.joint_state_publisher_gui import JointStatePublisherGui, PROGRAM
    from robot_state_publisher.node_arguments import file_argument

    return JointStatePublisherGui(file_argument(PROGRAM, words))


def main(args: Sequence[str] | None = None) -> None:
    """
    Run joint_state_publisher_gui; exit with its status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    sys.exit(run_node(_make_node, args))


if __name__ == '__main__':
    main()
