# SPDX-License-Identifier: Apache-2.0
"""State topics of one robot."""

from __future__ import annotations

from humanoid_control.backends import Observation
from humanoid_control.hosting.parameters import HostParameters, WALKING
from humanoid_control.hosting.rate_limiter import RateLimiter
from humanoid_control.hosting.topics.imu import ImuTopic
from humanoid_control.hosting.topics.joint_states import JointStatesTopic
from humanoid_control.hosting.topics.odometry import ODOM, OdometryTopics
from humanoid_control.hosting.topics.walk import BalanceTopics, FootstepsTopic, WalkingStateTopic
from humanoid_control.hosting.walking_robot import WalkingRobotControl
from rclpy.node import Node

BLOCKED = 'blocked'
"""Walking state of a robot that an obstacle blocks, whether it steps back or stands."""


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
        self, node: Node, name: str, robot: WalkingRobotControl, parameters: HostParameters
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
        state = (BLOCKED if walker.is_blocked else walker.phase) if mode == WALKING else mode
        if state is not None:
            self._state.publish(state)
