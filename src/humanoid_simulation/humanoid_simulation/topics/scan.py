# SPDX-License-Identifier: Apache-2.0
"""The laser scanners of all robots of a world, on ROS topics."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from humanoid_common.qos import SENSOR
from humanoid_control.hosting.pacing import RateLimiter
from humanoid_control.hosting.topics.filling import fill_stamp, topic
from humanoid_simulation.laser_scanner import LaserScanner, Ranges, ScanNoise
from humanoid_simulation.simulator_parameters import LaserParameters
import mujoco
import numpy as np
from rclpy.node import Node
from rclpy.publisher import Publisher
from sensor_msgs.msg import LaserScan

FRAME = 'laser'
"""The frame of the scanner, without the prefix of the robot."""


@dataclass(eq=False)
class _Scanner:
    """A scanner, with its message and its publisher."""

    core: LaserScanner
    message: LaserScan
    ranges_m: Ranges
    publisher: Publisher


class ScanTopics:
    """
    Publishes `scan` for each robot, at a rate in simulated time, while there are subscribers.

    Scans show the state at the time of their stamp, in a copy of it: the physics is not affected.

    Parameters
    ----------
    node
        The node that publishes.
    links
        The name of the scanner's link in the model, by the namespace of its robot relative to
        the node: '' for a robot alone.
    model
        The compiled world.
    settings
        The pattern of the rays, and the rate.
    prefix
        Prefix of the frame names.
    noise
        Noise of the ranges.

    Raises
    ------
    SimulationError
        The model does not have the links.

    """

    def __init__(
        self,
        node: Node,
        links: Mapping[str, str],
        model: mujoco.MjModel,
        settings: LaserParameters,
        prefix: str = '',
        noise: ScanNoise = ScanNoise(),
    ) -> None:
        self._model, self._data = model, mujoco.MjData(model)
        pattern = settings.scan_pattern

        def cores(model: mujoco.MjModel) -> list[LaserScanner]:
            return [
                LaserScanner(model, link, pattern, noise, number)
                for number, link in enumerate(links.values())
            ]

        self._make_cores = cores
        self._scanners = [
            _scanner(node, robot, core, prefix) for robot, core in zip(links, cores(model))
        ]
        self.change(settings)

    def change_model(self, model: mujoco.MjModel) -> None:
        """
        Switch to another model of the world, from the next sweep on.

        Parameters
        ----------
        model
            The compiled world.

        Raises
        ------
        SimulationError
            It has no link for one of the scanners.

        """
        self._model, self._data = model, mujoco.MjData(model)
        for scanner, core in zip(self._scanners, self._make_cores(model)):
            scanner.core = core

    def change(self, settings: LaserParameters) -> None:
        """
        Set the rate of the scans; the pattern of the rays stays.

        Parameters
        ----------
        settings
            The parameters, of which `scan_rate_hz` is used.

        """
        self._due = RateLimiter(settings.scan_rate_hz)
        for scanner in self._scanners:
            rate_hz = settings.scan_rate_hz
            scanner.message.scan_time = 1.0 / rate_hz if rate_hz > 0.0 else 0.0

    def tell(self, time_s: float, data: mujoco.MjData) -> None:
        """
        Publish a scan of each scanner that has subscribers, if it is due.

        Parameters
        ----------
        time_s
            Simulated time of the state, which is the stamp.
        data
            State of the world, of which `qpos` is read.

        """
        if not self._due.is_due(time_s):
            return
        wanted = [each for each in self._scanners if each.publisher.get_subscription_count()]
        if wanted:
            self._data.qpos[:] = data.qpos
            mujoco.mj_kinematics(self._model, self._data)
        for scanner in wanted:
            fill_stamp(scanner.message.header.stamp, time_s)
            scanner.ranges_m[:] = scanner.core.sweep(self._data, round(time_s * 1e9))
            scanner.publisher.publish(scanner.message)


def _scanner(node: Node, robot: str, core: LaserScanner, prefix: str) -> _Scanner:
    """Create the message and the publisher of a scanner."""
    pattern = core.pattern
    message = LaserScan(
        angle_min=pattern.angle_min_rad,
        angle_max=pattern.angle_max_rad,
        angle_increment=pattern.angle_increment_rad,
        range_min=pattern.range_min_m,
        range_max=pattern.range_max_m,
        ranges=[0.0] * pattern.rays,
    )
    message.header.frame_id = f'{prefix}{FRAME}'
    ranges_m = np.frombuffer(message.ranges, dtype=np.float32)
    publisher = node.create_publisher(LaserScan, topic(robot, 'scan'), SENSOR)
    return _Scanner(core, message, ranges_m, publisher)
