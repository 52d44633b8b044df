# SPDX-License-Identifier: Apache-2.0
"""Run the simulator as users do, let its robot walk, and measure its cost."""

from __future__ import annotations

from dataclasses import dataclass
import os
from statistics import mean
import sys
import time
from typing import Any

from domain_coordinator import domain_id
from geometry_msgs.msg import Twist
from humanoid_common.qos import SENSOR
from measuring import cpu_s, own_node, running
import rclpy
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Float64

SECONDS = 10.0
SETTLE_S = 3.0
TIMEOUT_S = 60.0
SEND_S = 0.1


@dataclass(frozen=True)
class Share:
    """The share of a core that the simulator uses, and its real-time factor."""

    cpu: float
    factor: float


def simulator_share(
    real_time_factor: float, forward_m_s: float, scene: str = 'flat', scans: bool = False
) -> Share:
    """
    Start the simulator without a camera, let the robot walk, and measure.

    Parameters
    ----------
    real_time_factor
        The limit of the real-time factor; 0 for as fast as possible.
    forward_m_s
        The commanded forward velocity.
    scene
        The name of the scene.
    scans
        Whether to subscribe to the laser scanner, which costs nothing otherwise.

    Raises
    ------
    TimeoutError
        The simulator has not started.

    """
    with domain_id() as domain:
        os.environ['ROS_DOMAIN_ID'] = str(domain)
        command = _simulator(real_time_factor, scene)
        with running(command) as process, own_node('driver') as node:
            driver = _Driver(node, forward_m_s)
            if scans:
                driver.listen_to_scans()
            driver.wait_for_factor()
            driver.drive(SETTLE_S)
            begin_s, begin_cpu_s = time.monotonic(), cpu_s(process.pid)
            factors = driver.drive(SECONDS)
            wall_s = time.monotonic() - begin_s
            return Share((cpu_s(process.pid) - begin_cpu_s) / wall_s, mean(factors))


def _simulator(real_time_factor: float, scene: str) -> list[str]:
    """Return the command of a simulator that renders no camera images."""
    settings = {
        'real_time_factor': real_time_factor,
        'camera_rate_hz': 0.0,
        'scene': scene,
    }
    command = [sys.executable, '-m', 'humanoid_simulation.starting', '--ros-args']
    for name, value in settings.items():
        command += ['-p', f'{name}:={value}']
    return command


class _Driver:
    """Node that publishes a velocity, and subscribes to the real-time factor."""

    def __init__(self, node: Any, forward_m_s: float) -> None:
        self._node = node
        self._factors: list[float] = []
        self._velocity = Twist()
        self._velocity.linear.x = forward_m_s
        self._publisher = node.create_publisher(Twist, 'cmd_vel', 1)
        node.create_timer(SEND_S, lambda: self._publisher.publish(self._velocity))
        node.create_subscription(
            Float64, 'real_time_factor', lambda message: self._factors.append(message.data), 10
        )

    def listen_to_scans(self) -> None:
        """Subscribe to the laser scanner."""
        self._node.create_subscription(LaserScan, 'scan', lambda scan: None, SENSOR)

    def wait_for_factor(self) -> None:
        """Wait until the simulator publishes its real-time factor."""
        end_s = time.monotonic() + TIMEOUT_S
        while not self._factors:
            if time.monotonic() > end_s:
                raise TimeoutError('the simulator has not started')
            rclpy.spin_once(self._node, timeout_sec=0.1)

    def drive(self, duration_s: float) -> list[float]:
        """Drive for some time; return the real-time factors received meanwhile."""
        self._factors.clear()
        end_s = time.monotonic() + duration_s
        while (left_s := end_s - time.monotonic()) > 0:
            rclpy.spin_once(self._node, timeout_sec=left_s)
        return list(self._factors)
