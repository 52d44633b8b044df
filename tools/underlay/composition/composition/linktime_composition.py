# SPDX-License-Identifier: Apache-2.0
"""A program that runs the components that its package registers, in one process."""

from __future__ import annotations

from collections.abc import Sequence
import sys

from rclcpp_components.registry import find_component, registered_components
from rclpy.node import Node
from tf2_ros.program import run_node

__all__ = ['main']

PACKAGE = 'composition'
LEFT_OUT = f'{PACKAGE}::NodeLikeListener'
"""The same node as the listener."""


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the components; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """

    def make(_: list[str]) -> Node:
        names = sorted(registered_components(PACKAGE).keys() - {LEFT_OUT})
        first, *others = (find_component(PACKAGE, name)() for name in names)
        for name in names:
            first.get_logger().info(f'Loaded {name}')
        first.companions = tuple(others)
        return first

    return run_node(make, args)


if __name__ == '__main__':
    sys.exit(main())
