# SPDX-License-Identifier: Apache-2.0
"""Check the nodes in this process."""

from __future__ import annotations

from collections.abc import Iterator

from humanoid_common.testing.ros import ros_sandbox, RosSandbox
import pytest
from rcl_interfaces.msg import Log
from rclpy.parameter import Parameter
from sensor_msgs.msg import Temperature
from temperature_monitor.temp_analyzer import TempAnalyzer
from temperature_monitor.temp_publisher import TempPublisher
from temperature_monitor.thermometer import generator_of, Thermometer

TOPIC = 'temperature'


@pytest.fixture(name='ros')
def _ros() -> Iterator[RosSandbox]:
    """Give a domain of its own."""
    with ros_sandbox() as sandbox:
        yield sandbox


def readings_of(ros: RosSandbox) -> list[Temperature]:
    """Collect the readings."""
    readings: list[Temperature] = []
    ros.observer().create_subscription(Temperature, TOPIC, readings.append, 100)
    return readings


def test_reading(ros: RosSandbox) -> None:
    """A reading carries temperature, variance, frame and time."""
    readings = readings_of(ros)
    ros.start(TempPublisher, {'rate_hz': 50.0, 'frame_id': 'lab'})
    ros.wait_until(lambda: len(readings) >= 5, what='readings')
    assert all(20.0 <= reading.temperature <= 30.0 for reading in readings)
    assert readings[0].variance == pytest.approx(100.0 / 12.0)
    assert readings[0].header.frame_id == 'lab' and readings[0].header.stamp.sec > 0


def test_seed(ros: RosSandbox) -> None:
    """With a seed, the readings are those of its random numbers."""
    generator = generator_of(7)
    expected = {Thermometer(20.0, 30.0).read(generator) for _ in range(500)}
    readings = readings_of(ros)
    ros.start(TempPublisher, {'rate_hz': 50.0, 'seed': 7})
    ros.wait_until(lambda: len(readings) >= 5, what='readings')
    assert {reading.temperature for reading in readings} <= expected


def test_range_changes_while_running(ros: RosSandbox) -> None:
    """A new range holds from the next reading on; an empty one is refused."""
    readings = readings_of(ros)
    node = ros.start(TempPublisher, {'rate_hz': 50.0})
    assert not node.set_parameters([Parameter('max_celsius', value=10.0)])[0].successful
    assert node.set_parameters([Parameter('max_celsius', value=20.5)])[0].successful
    ros.wait_until(lambda: len(readings) >= 5, what='readings')
    assert readings[-1].temperature <= 20.5
    assert readings[-1].variance == pytest.approx(0.25 / 12.0)


def test_analyzer(ros: RosSandbox) -> None:
    """Hot readings are warned of, and the return to normal is told."""
    logs: list[tuple[bytes, str]] = []
    observer = ros.observer()
    observer.create_subscription(
        Log, '/rosout', lambda log: logs.append((log.level, log.msg)), 100
    )
    publisher = observer.create_publisher(Temperature, TOPIC, 10)
    node = ros.start(TempAnalyzer)
    assert node.set_parameters([Parameter('threshold_celsius', value=40)])[0].successful
    ros.wait_until(lambda: publisher.get_subscription_count() == 1, what='the subscription')
    for celsius in (39.0, 41.0, 30.0):
        publisher.publish(Temperature(temperature=celsius))
    ros.wait_until(lambda: any('normal' in text for _, text in logs), what='the return')
    warnings = [text for level, text in logs if level == Log.WARN]
    assert warnings == ['41.0 °C is above 40.0 °C']
