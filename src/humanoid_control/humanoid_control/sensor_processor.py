# SPDX-License-Identifier: Apache-2.0
"""Node that monitors the joint commands and reports the first joint."""

from __future__ import annotations

import sys
import time
from typing import Any

from humanoid_common.node_parameters import NodeParameters
from humanoid_common.qos import STATE
from humanoid_common.running import run_node
from humanoid_control.joint_report import JointReporter
from humanoid_control.sensor_processor_parameters import SensorProcessorParameters
from rclpy.node import Node
from sensor_msgs.msg import JointState


class SensorProcessor(Node):
    """
    Node that logs the position of the first joint on the topic `joint_commands`.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('sensor_processor', **options)
        self._settings = NodeParameters(self, SensorProcessorParameters, self._change)
        self._reporter = JointReporter(self._settings.current.report_period_s)
        self.create_subscription(JointState, 'joint_commands', self._process, STATE)
        self.get_logger().info('Sensor Processor started')

    def _process(self, message: JointState) -> None:
        """Log the first joint when a report is due."""
        line = self._reporter.report(message.name, message.position, time.monotonic())
        if line is not None:
            self.get_logger().info(line)

    def _change(self, parameters: SensorProcessorParameters) -> None:
        """Apply changed parameters."""
        self._reporter.period_s = parameters.report_period_s


def main() -> int:
    """Run the node."""
    return run_node(SensorProcessor)


if __name__ == '__main__':
    sys.exit(main())
