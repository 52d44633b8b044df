# SPDX-License-Identifier: Apache-2.0
"""Publish temperatures that are made up."""

from __future__ import annotations

from dataclasses import dataclass
import sys
from typing import Any

from humanoid_common.node_parameters import NodeParameters
from humanoid_common.parameters import parameter, ParameterError
from humanoid_common.periodic import PeriodicTimer
from humanoid_common.qos import STATE
from humanoid_common.running import run_node
from rclpy.node import Node
from sensor_msgs.msg import Temperature
from temperature_monitor.thermometer import COLDEST_CELSIUS, generator_of, Thermometer


@dataclass(frozen=True)
class PublisherParameters:
    """How often to publish, and what."""

    rate_hz: float = parameter(
        1.0, 'Number of readings published per second.', at_least=0.01, at_most=1000.0
    )
    min_celsius: float = parameter(
        20.0, 'The lowest reading.', at_least=COLDEST_CELSIUS, at_most=10000.0
    )
    max_celsius: float = parameter(
        30.0, 'The highest reading.', at_least=COLDEST_CELSIUS, at_most=10000.0
    )
    frame_id: str = parameter('thermometer', 'Frame of the thermometer.')
    seed: int = parameter(
        -1,
        'Seed of the random readings; -1 gives different readings on every run.',
        at_least=-1,
        at_most=2**31 - 1,
        read_only=True,
    )

    def __post_init__(self) -> None:
        """Check that there is a range to draw from."""
        if self.min_celsius >= self.max_celsius:
            raise ParameterError(
                f"Parameter 'min_celsius' is {self.min_celsius}, but must be below "
                f"'max_celsius', which is {self.max_celsius}.",
                'min_celsius',
                'max_celsius',
            )

    @property
    def thermometer(self) -> Thermometer:
        """Return the thermometer that the parameters describe."""
        return Thermometer(self.min_celsius, self.max_celsius)


class TempPublisher(Node):
    """
    Publishes readings of a thermometer on the topic `temperature`.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        """Start to publish."""
        super().__init__('temp_publisher', **options)
        self._settings = NodeParameters(self, PublisherParameters, self._change)
        parameters = self._settings.current
        self._generator = generator_of(parameters.seed)
        self._publisher = self.create_publisher(Temperature, 'temperature', STATE)
        self._timer = PeriodicTimer(self, parameters.rate_hz, self._publish)
        self.get_logger().info(f'Publishing the temperature ({parameters.rate_hz:g} Hz)')

    def _publish(self, now_s: float) -> None:
        """Publish the next reading."""
        thermometer = self._settings.current.thermometer
        message = Temperature(
            temperature=thermometer.read(self._generator), variance=thermometer.variance_celsius2
        )
        message.header.stamp = self.get_clock().now().to_msg()
        message.header.frame_id = self._settings.current.frame_id
        self._publisher.publish(message)

    def _change(self, parameters: PublisherParameters) -> None:
        """Follow a change of the rate; all else is looked up for each reading."""
        self._timer.set_rate(parameters.rate_hz)


def main() -> int:
    """Run the node."""
    return run_node(TempPublisher)


if __name__ == '__main__':
    sys.exit(main())
