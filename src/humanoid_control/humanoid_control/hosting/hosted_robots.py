# SPDX-License-Identifier: Apache-2.0
"""The robots of a node, with their topics, actions and services."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Protocol

from geometry_msgs.msg import Pose, Twist
from humanoid_common.errors import UserError
from humanoid_common.qos import COMMAND
from humanoid_control.backends import Observation
from humanoid_control.controllers.modes import POLICY
from humanoid_control.emergency_stop import StopListener
from humanoid_control.hosting.controller_actions import ControllerActions
from humanoid_control.hosting.controller_services import ControllerServices
from humanoid_control.hosting.conversions import body_pose_of, points_of, velocity_of
from humanoid_control.hosting.diagnostics import RobotHealth
from humanoid_control.hosting.pacing import RateLimiter
from humanoid_control.hosting.parameters import HostParameters, WALKING
from humanoid_control.hosting.policies import Policies, PolicyHost
from humanoid_control.hosting.reports import FallReport, ObstacleReport, Refusals
from humanoid_control.hosting.robot_control import RobotControl
from humanoid_control.hosting.topics.filling import topic
from humanoid_control.hosting.topics.sensors import ImuTopic, JointStatesTopic
from humanoid_control.hosting.topics.walk import (
    BalanceTopics,
    FootstepsTopic,
    ODOM,
    OdometryTopics,
    WalkingStateTopic,
)
from humanoid_control.walking.walker import Walker
from rclpy.node import Node
from sensor_msgs.msg import JointState
from trajectory_msgs.msg import JointTrajectory

BLOCKED = 'blocked'
"""Walking state of a robot that an obstacle blocks, whether it steps back or stands."""


class HostedRobot(PolicyHost, Protocol):
    """What a node needs to know of a robot, however it is built."""

    @property
    def walker(self) -> Walker:
        """Return its walker, whose state is published."""

    @property
    def control(self) -> RobotControl:
        """Return its control, which takes the commands."""


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
        robots: Mapping[str, HostedRobot],
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
        self._policies = Policies(node, robots, parameters)
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
            self._falls[name].look(walker.has_fallen, walker.recovery.has_given_up)
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
            trouble=manager.claims.trouble,
            is_blocked=robot.walker.is_blocked,
            holds_because=self._inputs[name].stop.guard.reason,
            claimed=manager.claims.claimed(),
        )


class RobotInputs:
    """
    Subscriptions to the command topics of one robot.

    They are `cmd_vel`, `body_pose`, `joint_commands`, `joint_trajectory` and the topics of a stop.
    Commands are stored until the next tick, or rejected with the reason in the log.

    Parameters
    ----------
    node
        The node that subscribes.
    robot
        Name of the robot, which is its namespace; empty if it is alone.
    control
        The control of the robot, which receives the commands.
    heartbeat_timeout_s
        How long the console in control may be silent before the robot holds still, in real time.

    Attributes
    ----------
    stop
        Decides whether the robot must hold still.

    """

    def __init__(
        self, node: Node, robot: str, control: RobotControl, heartbeat_timeout_s: float
    ) -> None:
        self._control = control
        self._place = topic(robot, '')
        self._refusals = Refusals(node.get_logger().warning)
        self.stop = StopListener(node, heartbeat_timeout_s, robot)
        for kind, name, take in (
            (Twist, 'cmd_vel', self._walk),
            (Pose, 'body_pose', self._bend),
            (JointState, 'joint_commands', self._follow),
            (JointTrajectory, 'joint_trajectory', self._run),
        ):
            node.create_subscription(kind, topic(robot, name), take, COMMAND)

    def look(self) -> None:
        """Hold the robot still, or release it, by the stop state. Call before each tick."""
        self._control.hold_still(self.stop.must_hold)

    def _walk(self, message: Twist) -> None:
        self._attempt('cmd_vel', lambda: self._control.walk(velocity_of(message)))

    def _bend(self, message: Pose) -> None:
        self._attempt('body_pose', lambda: self._control.hold_body(body_pose_of(message)))

    def _follow(self, message: JointState) -> None:
        self._attempt(
            'joint_commands',
            lambda: self._control.follow(
                message.name, message.position, message.velocity, message.effort
            ),
        )

    def _run(self, message: JointTrajectory) -> None:
        self._attempt(
            'joint_trajectory',
            lambda: self._control.run(message.joint_names, points_of(message)),
        )

    def _attempt(self, name: str, command: Callable[[], None]) -> None:
        """Execute a command; log the reason if it is rejected."""
        try:
            command()
        except UserError as error:
            self._refusals.add(f"Rejected a message on '{self._place}{name}'. {error}")


class RobotOutputs:
    """
    Publishers of the sensor values and the walk of one robot, each at its own rate.

    Parameters
    ----------
    node
        The node that publishes.
    name
        Name of the robot, which is its namespace; empty if it is alone.
    robot
        Its walker and its control.
    parameters : HostParameters
        Rates of the topics, and the prefix of the frame names.

    """

    def __init__(
        self, node: Node, name: str, robot: HostedRobot, parameters: HostParameters
    ) -> None:
        odom = parameters.prefix + ODOM
        self._robot = robot
        self._joint_states = JointStatesTopic(node, name, robot.control.manager.joints)
        self._imu = ImuTopic(node, name, parameters.prefix, robot.walker.imu)
        self._odometry = OdometryTopics(node, name, parameters.prefix)
        self._state = WalkingStateTopic(node, name)
        self._balance = BalanceTopics(node, name, odom)
        self._footsteps = FootstepsTopic(node, name, odom, robot.walker.shape)
        self.change(parameters)

    def change(self, parameters: HostParameters) -> None:
        """
        Set the publishing rates; each topic is then due at once.

        Parameters
        ----------
        parameters : HostParameters
            The rates in Hz; 0 is never.

        """
        self._joints_due = RateLimiter(parameters.joint_states_rate_hz)
        self._imu_due = RateLimiter(parameters.imu_rate_hz)
        self._odometry_due = RateLimiter(parameters.odometry_rate_hz)
        self._debug_due = RateLimiter(parameters.debug_rate_hz)

    def publish(self, observation: Observation) -> None:
        """
        Publish the topics of the robot that are due.

        Parameters
        ----------
        observation
            The newest observation; its time decides what is due, and stamps the messages.

        """
        now_s = observation.time_s
        if self._joints_due.is_due(now_s):
            self._joint_states.publish(observation)
        if self._imu_due.is_due(now_s):
            self._imu.publish(observation)
        self._publish_state()
        odometry, debug = self._odometry_due.is_due(now_s), self._debug_due.is_due(now_s)
        status = self._robot.walker.status if odometry or debug else None
        if status is not None and odometry:
            self._odometry.publish(now_s, status.odometry)
        if status is not None and debug:
            self._balance.publish(now_s, status)
            self._footsteps.publish(now_s, status)

    def _publish_state(self) -> None:
        """Publish the walking state, or the mode if the robot does not walk."""
        mode = self._robot.control.manager.mode
        walker = self._robot.walker
        if mode == WALKING or (mode == POLICY and walker.has_fallen):
            state = BLOCKED if walker.is_blocked else walker.phase
        else:
            state = mode
        if state is not None:
            self._state.publish(state, walker.recovery.will_get_up)
