# SPDX-License-Identifier: Apache-2.0
"""Node that runs robots without physics: joints follow their targets."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
import sys
import time
from typing import Any

from humanoid_common.errors import UserError
from humanoid_common.node_parameters import NodeParameters
from humanoid_common.periodic import clock_s
from humanoid_common.running import run_node
from humanoid_control.backends import Observation
from humanoid_control.hosting.control_loop import ControlLoop
from humanoid_control.hosting.diagnostics import DuplicatePublisherCheck, HostDiagnostics
from humanoid_control.hosting.host import Host
from humanoid_control.hosting.hosted_robots import HostedRobots
from humanoid_control.hosting.pacing import RealTimePace, Stamps
from humanoid_control.hosting.parameters import HostParameters
from humanoid_control.hosting.reports import Refusals
from humanoid_control.hosting.topics.filling import topic
from humanoid_control.hosting.walking_robot import WalkingRobotControl
from humanoid_control.mock_backend import MockBackend
from humanoid_control.walking.commands import VelocityCommand
from humanoid_description.drives import load_drives
from humanoid_description.errors import DescriptionError
from humanoid_description.expansion import humanoid_urdf
from humanoid_description.loading import load_robot
from rclpy.node import Node

NO_TURN = (
    'The mock robot does not turn: its IMU is always level and faces forward. It walks straight '
    'or sideways; to turn, use the simulator.'
)


class MockRobot(Node):
    """
    Node that accepts commands and publishes joint states like a simulator, without physics.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('robot', **options)
        self._settings = NodeParameters(self, HostParameters, self._change)
        parameters = self._settings.current
        controls, backend = self._build(parameters)
        self._stamps = Stamps()
        self._robots = HostedRobots(self, controls, parameters, 'humanoid_control/MockBackend')
        loop = ControlLoop(backend, {name: robot.control for name, robot in controls.items()})
        period_s, pace = backend.period_s, RealTimePace(backend.period_s)
        self._host = Host(self, loop, pace, period_s, self._robots.look, self._tell)
        self._duplicates = DuplicatePublisherCheck(
            self, [topic(name, 'joint_states') for name in controls]
        )
        self._diagnostics = HostDiagnostics(self, self._host, self._robots)
        self.get_logger().info(
            f'Mock robot started: {len(backend.joints)} joints at {1.0 / period_s:g} Hz, '
            'without physics'
        )

    def _build(
        self, parameters: HostParameters
    ) -> tuple[dict[str, WalkingRobotControl], MockBackend]:
        """Build the control of every robot, and the backend that moves them."""
        scale, prefix, hands = parameters.scale, parameters.prefix, parameters.hands
        try:
            model = load_robot(humanoid_urdf(scale, prefix, hands=hands), 'the humanoid')
        except DescriptionError as error:
            raise UserError(f'The mock robot has no model. {error}') from error
        drives, say = (
            load_drives(scale, prefix, hands=hands),
            Refusals(self.get_logger().error).add,
        )
        walk = parameters.walk.scaled(scale)
        controls = {
            name: WalkingRobotControl.of(model, drives, walk, time.monotonic, say, self._able)
            for name in parameters.robots
        }
        return controls, MockBackend(
            drives,
            parameters.robots,
            1.0 / parameters.control_rate_hz,
            model.mass_kg,
            next(iter(controls.values())).home_rad,
            clock_s(self),
        )

    def _tell(self, observations: Mapping[str, Observation]) -> None:
        """Publish what is due after a tick, stamped by the node's clock."""
        robot_s = next(iter(observations.values())).time_s
        stamp_s = self._stamps.stamp_s(robot_s, clock_s(self))
        if stamp_s is not None:
            self._robots.tell(
                {
                    name: replace(observation, time_s=stamp_s)
                    for name, observation in observations.items()
                }
            )

    def _able(self, velocity: VelocityCommand) -> VelocityCommand:
        """Drop the turn from a velocity command, with a warning the first time."""
        if velocity.turn_rad_s:
            self.get_logger().warning(NO_TURN, once=True)
        return VelocityCommand(velocity.forward_m_s, velocity.left_m_s)

    def _change(self, parameters: HostParameters) -> None:
        """Apply changed parameters."""
        self._robots.change(parameters)


def main() -> int:
    """Run the node."""
    return run_node(MockRobot)


if __name__ == '__main__':
    sys.exit(main())
