# SPDX-License-Identifier: Apache-2.0
"""A node with a parameter that sets another one."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

from rclpy.node import Node
from rclpy.parameter import Parameter
from tf2_ros.program import run_node

__all__ = ['SetParametersCallback', 'main']


class SetParametersCallback(Node):
    """
    Has the parameters `param1` and `param2`; whoever sets `param1` also sets `param2` to 4.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('set_parameters_callback', **options)
        self.declare_parameter('param1', 0.0)
        self.declare_parameter('param2', 0.0)
        self.add_pre_set_parameters_callback(_also_set_second)
        self.add_post_set_parameters_callback(self._log)

    def _log(self, parameters: list[Parameter]) -> None:
        for parameter in parameters:
            self.get_logger().info(f"Parameter '{parameter.name}' is now {parameter.value}")


def _also_set_second(parameters: list[Parameter]) -> list[Parameter]:
    if not any(parameter.name == 'param1' for parameter in parameters):
        return parameters
    others = [parameter for parameter in parameters if parameter.name != 'param2']
    return [*others, Parameter('param2', value=4.0)]


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: SetParametersCallback(), args)


if __name__ == '__main__':
    sys.exit(main())
