# SPDX-License-Identifier: Apache-2.0
"""Report the robot model that was handed to this node."""

from __future__ import annotations

from dataclasses import dataclass
import sys
from typing import Any

from humanoid_common.node_parameters import NodeParameters
from humanoid_common.parameters import parameter
from humanoid_common.running import run_node
from rclpy.node import Node
from robot_control.urdf import parse_urdf


@dataclass(frozen=True)
class ReporterParameters:
    """What to report."""

    robot_description: str = parameter('', 'The text of a URDF file.', read_only=True)


class DescriptionReporter(Node):
    """
    Logs the links and joints of the robot in its parameter `robot_description`.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        """Read the model and report it."""
        super().__init__('description_reporter', **options)
        parameters = NodeParameters(self, ReporterParameters)
        self.model = parse_urdf(parameters.current.robot_description)
        for line in self.model.describe():
            self.get_logger().info(line)


def main() -> int:
    """Run the node."""
    return run_node(DescriptionReporter)


if __name__ == '__main__':
    sys.exit(main())
