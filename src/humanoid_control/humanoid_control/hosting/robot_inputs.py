# SPDX-License-Identifier: Apache-2.0
"""Command topics of one robot."""

from __future__ import annotations

from collections.abc import Callable

from geometry_msgs.msg import Pose, Twist
from humanoid_common.qos import COMMAND
from humanoid_control.controllers import CommandError
from humanoid_control.hosting.conversions import body_pose_of, points_of, velocity_of
from humanoid_control.hosting.refusals import Refusals
from humanoid_control.hosting.robot_control import RobotControl
from humanoid_control.hosting.topics.filling import topic
from humanoid_control.stop_listener import StopListener
from humanoid_control.walking.errors import WalkingError
from rclpy.node import Node
from sensor_msgs.msg import JointState
from trajectory_msgs.msg import JointTrajectory


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
        except (CommandError, WalkingError) as error:
            self._refusals.add(f"Refused a message on '{self._place}{name}'. {error}")
