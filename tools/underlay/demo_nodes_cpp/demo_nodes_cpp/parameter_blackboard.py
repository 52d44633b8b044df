# SPDX-License-Identifier: Apache-2.0
"""A node whose parameters are those that others set."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

from rclpy.node import Node
from tf2_ros.program import run_node

__all__ = ['ParameterBlackboard', 'main']


class ParameterBlackboard(Node):
    """
    Accepts any parameter of any type, from its start and later.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__(
            'parameter_blackboard',
            allow_undeclared_parameters=True,
            automatically_declare_parameters_from_overrides=True,
            **options,
        )
        count = len(self.get_parameters_by_prefix(''))
        self.get_logger().info(
            f"Parameter blackboard node named '{self.get_fully_qualified_name()}' ready, and "
            f"serving '{count}' parameters already!"
        )


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: ParameterBlackboard(), args)


if __name__ == '__main__':
    sys.exit(main())
