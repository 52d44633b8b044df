# SPDX-License-Identifier: Apache-2.0
"""A node that accepts only even numbers as parameters."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter
from tf2_ros.program import run_node

__all__ = ['EvenParameterNode', 'main']


class EvenParameterNode(Node):
    """
    Accepts any parameter that is an even integer.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('even_parameters_node', allow_undeclared_parameters=True, **options)
        self.add_on_set_parameters_callback(self._check)

    def _check(self, parameters: list[Parameter]) -> SetParametersResult:
        for parameter in parameters:
            is_integer = parameter.type_ == Parameter.Type.INTEGER
            if not is_integer or parameter.value % 2:
                self.get_logger().info(
                    f"Requested value '{parameter.value}' for parameter '{parameter.name}' is not "
                    f'an {"even number" if is_integer else "integer"}: rejecting change...'
                )
                return SetParametersResult(
                    successful=False, reason='only even integers can be set'
                )
        for parameter in parameters:
            self.get_logger().info(
                f"parameter '{parameter.name}' has changed and is now: {parameter.value}"
            )
        return SetParametersResult(successful=True)


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: EvenParameterNode(), args)


if __name__ == '__main__':
    sys.exit(main())
