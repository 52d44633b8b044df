# SPDX-License-Identifier: Apache-2.0
"""Warn when it is hot."""

from __future__ import annotations

from dataclasses import dataclass
import sys
from typing import Any

from humanoid_common.node_parameters import NodeParameters
from humanoid_common.parameters import parameter
from humanoid_common.qos import STATE
from humanoid_common.running import run_node
from rclpy.node import Node
from sensor_msgs.msg import Temperature
from temperature_monitor.heat_alarm import HeatAlarm
from temperature_monitor.thermometer import COLDEST_CELSIUS


@dataclass(frozen=True)
class AnalyzerParameters:
    """When it is hot."""

    threshold_celsius: float = parameter(
        25.0, 'Warn about readings above this.', at_least=COLDEST_CELSIUS, at_most=10000.0
    )


class TempAnalyzer(Node):
    """
    Watches the topic `temperature`.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        """Start to listen."""
        super().__init__('temp_analyzer', **options)
        self._settings = NodeParameters(self, AnalyzerParameters, self._change)
        self._alarm = HeatAlarm(self._settings.current.threshold_celsius)
        self.create_subscription(Temperature, 'temperature', self._judge, STATE)
        self.get_logger().info(
            f'Watching for temperatures above {self._alarm.threshold_celsius:g} °C'
        )

    def _judge(self, message: Temperature) -> None:
        """Log what there is to say about a reading."""
        notice = self._alarm.judge(message.temperature)
        if notice is None:
            return
        if notice.is_warning:
            self.get_logger().warning(notice.text)
        else:
            self.get_logger().info(notice.text)

    def _change(self, parameters: AnalyzerParameters) -> None:
        """Follow a change of the threshold."""
        self._alarm.threshold_celsius = parameters.threshold_celsius


def main() -> int:
    """Run the node."""
    return run_node(TempAnalyzer)


if __name__ == '__main__':
    sys.exit(main())
