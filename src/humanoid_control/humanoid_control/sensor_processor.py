# SPDX-License-Identifier: Apache-2.0
"""Node that monitors the joint commands and reports the first joint."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
import sys
import time
from typing import Any

from humanoid_common.node_parameters import NodeParameters
from humanoid_common.parameters import parameter
from humanoid_common.qos import STATE
from humanoid_common.running import run_node
from rclpy.node import Node
from sensor_msgs.msg import JointState


@dataclass(frozen=True)
class SensorProcessorParameters:
    """Report period of the sensor processor."""

    report_period_s: float = parameter(
        1.0, 'Minimum time between two reports.', at_least=0.1, at_most=3600.0
    )


class JointReporter:
    """
    Formatter of the first joint of joint states as a line of text, at most once per period.

    Parameters
    ----------
    period_s
        Minimum time between two reports.

    """

    def __init__(self, period_s: float) -> None:
        self.period_s = period_s
        self._last_s: float | None = None

    def report(
        self,
        names: Sequence[str],
        positions_rad: Sequence[float],
        now_s: float,
    ) -> str | None:
        """
        Format the position of the first joint, at most once per period.

        Parameters
        ----------
        names, positions_rad
            The joint state, in the same order.
        now_s
            Time of a steady clock.

        Returns
        -------
        str or None
            One line; None if the period has not passed yet, or there is no joint.

        """
        if not names or not positions_rad or not self._is_due(now_s):
            return None
        self._last_s = now_s
        return f'{names[0]}: {positions_rad[0]:.3f} rad'

    def _is_due(self, now_s: float) -> bool:
        """Check whether a period has passed since the last report."""
        return self._last_s is None or now_s - self._last_s >= self.period_s


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
