# SPDX-License-Identifier: Apache-2.0
"""The topics on which one robot says how it is."""

from __future__ import annotations

from humanoid_control.backends import Observation
from humanoid_control.hosting.every import Every
from humanoid_control.hosting.parameters import HostParameters, WALKING
from humanoid_control.hosting.topics.imu import ImuTopic
from humanoid_control.hosting.topics.joint_states import JointStatesTopic
from humanoid_control.hosting.topics.odometry import ODOM, OdometryTopics
from humanoid_control.hosting.topics.walk import BalanceTopics, FootstepsTopic, WalkingStateTopic
from humanoid_control.hosting.walking_robot import WalkingRobotControl
from humanoid_control.walking.status import WalkStatus
from rclpy.node import Node


class RobotOutputs:
    """Publishes what was observed and how the robot walks, each at its own rate."""

    def __init__(
        self, node: Node, name: str, robot: WalkingRobotControl, parameters: HostParameters
    ) -> None:
        """Prepare all topics of a robot that has a name."""
        odom = parameters.prefix + ODOM
        self._robot = robot
        self._joint_states = JointStatesTopic(node, name, robot.control.manager.joints)
        self._imu = ImuTopic(node, name, parameters.prefix)
        self._odometry = OdometryTopics(node, name, parameters.prefix)
        self._state = WalkingStateTopic(node, name)
        self._balance = BalanceTopics(node, name, odom)
        self._footsteps = FootstepsTopic(node, name, odom, robot.walker.shape)
        self.change(parameters)

    def change(self, parameters: HostParameters) -> None:
        """Publish at other rates."""
        self._joints_due = Every(parameters.joint_states_rate_hz)
        self._imu_due = Every(parameters.imu_rate_hz)
        self._odometry_due = Every(parameters.odometry_rate_hz)
        self._debug_due = Every(parameters.debug_rate_hz)

    def publish(self, observation: Observation) -> None:
        """Publish what is due at the time of an observation."""
        now_s = observation.time_s
        if self._joints_due.is_due(now_s):
            self._joint_states.publish(observation)
        if self._imu_due.is_due(now_s):
            self._imu.publish(observation)
        odometry, debug = self._odometry_due.is_due(now_s), self._debug_due.is_due(now_s)
        status = self._robot.walker.status if odometry or debug else None
        if status is None:
            return
        self._state.publish(self._state_of(status))
        if odometry:
            self._odometry.publish(now_s, status.odometry)
        if debug:
            self._balance.publish(now_s, status)
            self._footsteps.publish(now_s, status)

    def _state_of(self, status: WalkStatus) -> str:
        """Return how the robot walks, or the mode in which it does not."""
        mode = self._robot.control.manager.mode
        return status.phase if mode == WALKING else mode
