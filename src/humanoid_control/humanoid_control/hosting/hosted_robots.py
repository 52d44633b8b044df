# SPDX-License-Identifier: Apache-2.0
"""The robots of a node, with their topics, actions and services."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from humanoid_control.backends import Observation
from humanoid_control.hosting.controller_actions import ControllerActions
from humanoid_control.hosting.controller_services import ControllerServices
from humanoid_control.hosting.fall_report import FallReport
from humanoid_control.hosting.obstacle_report import ObstacleReport
from humanoid_control.hosting.parameters import HostParameters
from humanoid_control.hosting.robot_inputs import RobotInputs
from humanoid_control.hosting.robot_outputs import RobotOutputs
from humanoid_control.hosting.walking_robot import WalkingRobotControl
from rclpy.node import Node


@dataclass(frozen=True)
class RobotHealth:
    """Health of a robot, for diagnostics."""

    mode: str
    walk: str
    trouble: str
    """The reason why the mode cannot work as it should; empty if it can."""
    is_blocked: bool
    """Whether something is in its way."""
    holds_because: str
    claimed: Mapping[str, str]
    """The joints that controllers have claimed from the mode, and these controllers."""


class HostedRobots:
    """
    Topics, actions and services of each robot, in its namespace.

    Parameters
    ----------
    node
        The node that offers them.
    robots
        Walker and control of each robot, by its name, which is its namespace.
    parameters : HostParameters
        Mode, rates, prefix and heartbeat timeout.
    hardware
        Class of the hardware component that moves the joints, as package/Class.

    Attributes
    ----------
    time_s
        Time of the newest observation; zero before the first one.

    """

    def __init__(
        self,
        node: Node,
        robots: Mapping[str, WalkingRobotControl],
        parameters: HostParameters,
        hardware: str,
    ) -> None:
        self._robots = dict(robots)
        self.time_s = 0.0
        timeout_s = parameters.heartbeat_timeout_s
        self._inputs = {
            name: RobotInputs(node, name, robot.control, timeout_s)
            for name, robot in robots.items()
        }
        self._outputs = {
            name: RobotOutputs(node, name, robot, parameters) for name, robot in robots.items()
        }
        self._actions = {
            name: ControllerActions(node, name, robot.control) for name, robot in robots.items()
        }
        rate_hz, prefix = parameters.control_rate_hz, parameters.prefix
        self._services = [
            ControllerServices(node, name, robot.control, hardware, rate_hz, prefix)
            for name, robot in robots.items()
        ]
        log = node.get_logger()
        self._falls = {name: FallReport(log, name) for name in robots}
        self._obstacles = {name: ObstacleReport(log, name) for name in robots}
        self.change(parameters)

    def change(self, parameters: HostParameters) -> None:
        """
        Apply changed parameters: the mode, the publishing rates and the heartbeat timeout.

        Parameters
        ----------
        parameters : HostParameters
            The new values; read-only ones take effect only at the start.

        """
        for robot in self._robots.values():
            robot.control.manager.switch(parameters.mode)
        for inputs in self._inputs.values():
            inputs.stop.guard.heartbeat_timeout_s = parameters.heartbeat_timeout_s
        for outputs in self._outputs.values():
            outputs.change(parameters)

    def look(self) -> None:
        """Apply the stop state of each robot. Call before each tick."""
        for inputs in self._inputs.values():
            inputs.look()

    def tell(self, observations: Mapping[str, Observation]) -> None:
        """
        Publish the topics, action feedback and log messages that are due; call it after each tick.

        Parameters
        ----------
        observations
            The observation of each robot at this tick, by name; its time stamps the messages.

        """
        for name, outputs in self._outputs.items():
            outputs.publish(observations[name])
            self.time_s = observations[name].time_s
            self._actions[name].tell(self.time_s)
            walker = self._robots[name].walker
            self._falls[name].look(walker.has_fallen)
            self._obstacles[name].look(walker.is_blocked)

    def health(self) -> dict[str, RobotHealth]:
        """Return the health of each robot, by name."""
        return {name: self._health_of(name) for name in self._robots}

    def _health_of(self, name: str) -> RobotHealth:
        robot = self._robots[name]
        manager = robot.control.manager
        return RobotHealth(
            mode=manager.mode,
            walk=robot.walker.phase or '',
            trouble=manager.trouble,
            is_blocked=robot.walker.is_blocked,
            holds_because=self._inputs[name].stop.guard.reason,
            claimed=manager.claimed(),
        )
