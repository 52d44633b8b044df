# SPDX-License-Identifier: Apache-2.0
"""Check what the simulator publishes on `scan`."""

from __future__ import annotations

from collections.abc import Iterator
import math
from typing import Any

from humanoid_common.parameters import build, ParameterError
from humanoid_common.qos import SENSOR
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_simulation.simulator import Simulator
from humanoid_simulation.simulator_parameters import LaserParameters
import pytest
from rclpy.parameter import Parameter
from sensor_msgs.msg import LaserScan

ROOM = {'scene': 'room', 'camera_rate_hz': 0.0, 'real_time_factor': 0.0}


@pytest.fixture(name='ros')
def _ros() -> Iterator[RosSandbox]:
    """Give a domain of its own."""
    with ros_sandbox() as sandbox:
        yield sandbox


def listen(ros: RosSandbox, topic: str = 'scan') -> list[LaserScan]:
    """Collect the sweeps of a topic."""
    scans: list[LaserScan] = []
    ros.observer().create_subscription(LaserScan, topic, scans.append, SENSOR)
    return scans


def stamp_s(scan: LaserScan) -> float:
    """Return the time of a sweep."""
    return float(scan.header.stamp.sec + scan.header.stamp.nanosec * 1e-9)


def test_sweeps(ros: RosSandbox) -> None:
    """Ten sweeps a second of 360 rays all round, in the frame of the scanner."""
    ros.start(Simulator, {**ROOM, 'prefix': 'my_'})
    scans = listen(ros)
    ros.wait_until(lambda: len(scans) >= 5, 60.0, 'sweeps')
    scan = scans[0]
    assert scan.header.frame_id == 'my_laser'
    assert len(scan.ranges) == 360 and not scan.intensities
    assert scan.angle_min == pytest.approx(-math.pi)
    assert scan.angle_increment == pytest.approx(math.radians(1.0))
    assert scan.angle_max == pytest.approx(math.radians(179.0))
    assert (scan.range_min, scan.range_max) == (pytest.approx(0.1), 12.0)
    assert (scan.scan_time, scan.time_increment) == (pytest.approx(0.1), 0.0)
    # The walls of the room are at 4 m ahead, and at 2 m behind the robot.
    assert scan.ranges[180] == pytest.approx(4.0, abs=0.05)
    assert scan.ranges[0] == pytest.approx(2.0, abs=0.05)
    steps_s = [stamp_s(later) - stamp_s(scan) for scan, later in zip(scans, scans[1:])]
    assert all(step_s / 0.1 == pytest.approx(round(step_s / 0.1)) for step_s in steps_s)


def test_another_pattern_rate_and_noise(ros: RosSandbox) -> None:
    """Rays, ranges, noise and drop-outs are parameters; the rate may change."""
    given = {'scan_rays': 90, 'scan_range_max_m': 3.0, 'sensor_noise': 1.0}
    node = ros.start(Simulator, {**ROOM, **given, 'scan_dropout_share': 0.2})
    scans = listen(ros)
    ros.wait_until(lambda: len(scans) >= 10, 60.0, 'sweeps')
    ranges = [value for scan in scans[:10] for value in scan.ranges]
    assert len(ranges) == 900
    assert 0.1 < sum(map(math.isnan, ranges)) / 900 < 0.3
    assert scans[0].ranges[45] == math.inf or math.isnan(scans[0].ranges[45])
    assert len({value for scan in scans[:10] for value in scan.ranges[:1]}) > 5
    node.set_parameters([Parameter('scan_rate_hz', value=50.0)])
    ros.wait_until(lambda: scans[-1].scan_time == pytest.approx(0.02), 60.0, 'the new rate')


def test_robots_in_their_namespaces(ros: RosSandbox) -> None:
    """Each robot measures from where it is."""
    ros.start(Simulator, {**ROOM, 'robots': ['one', 'two']})
    one, two = listen(ros, 'one/scan'), listen(ros, 'two/scan')
    ros.wait_until(lambda: bool(one) and bool(two), 60.0, 'sweeps of both')
    # The wall to the right is at 2.5 m from the first robot; to the left is the shelf, 1 m nearer
    # to the second one.
    assert one[0].ranges[90] == pytest.approx(2.5, abs=0.1)
    assert two[0].ranges[270] == pytest.approx(1.15, abs=0.1)


@pytest.mark.parametrize(
    ('name', 'value'),
    [
        ('scan_rate_hz', -1.0),
        ('scan_rays', 3),
        ('scan_range_min_m', 1.0),
        ('scan_range_max_m', 0.5),
        ('scan_range_max_m', math.inf),
    ],
)
def test_refused_parameters(name: str, value: Any) -> None:
    """A parameter out of its range is refused, by its name."""
    with pytest.raises(ParameterError, match=name):
        build(LaserParameters, {name: value})
