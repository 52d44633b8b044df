# SPDX-License-Identifier: Apache-2.0
"""Run robots without physics: what their joints are told comes true."""

from __future__ import annotations

from collections.abc import Mapping
import sys
import time
from typing import Any

from humanoid_common.node_parameters import NodeParameters
from humanoid_common.running import run_node
from humanoid_control.backends import Observation
from humanoid_control.backends.mock import MockBackend
from humanoid_control.hosting.control_loop import ControlLoop
from humanoid_control.hosting.host import Host
from humanoid_control.hosting.hosted_robots import HostedRobots
from humanoid_control.hosting.pacing import RealTimePace
from humanoid_control.hosting.parameters import HostParameters
from humanoid_control.hosting.walking_robot import WalkingRobotControl
from humanoid_description.drives import load_drives
from humanoid_description.expansion import humanoid_urdf
from humanoid_description.loading import load_robot
from rclpy.node import Node


class MockRobot(Node):
    """Takes commands and says where the joints are, as the simulator does, but without physics."""

    def __init__(self, **options: Any) -> None:
        """Start to run."""
        super().__init__('robot', **options)
        self._settings = NodeParameters(self, HostParameters, self._change)
        parameters = self._settings.current
        robots = self._controls(parameters)
        backend = _backend(robots, parameters)
        self._robots = HostedRobots(self, robots, parameters)
        loop = ControlLoop(backend, {name: robot.control for name, robot in robots.items()})
        pace = RealTimePace(backend.period_s)
        self._host = Host(self, loop, pace, self._robots.look, self._tell)
        self.get_logger().info(
            f'Mock robot started: {len(backend.joints)} joints, without physics '
            f'({parameters.control_rate_hz:g} Hz)'
        )
