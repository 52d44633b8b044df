# SPDX-License-Identifier: Apache-2.0
"""Action servers of the controllers of a robot."""

from __future__ import annotations

from typing import Any

from humanoid_control.hosting.follow_joint_trajectory import FollowJointTrajectoryServer
from humanoid_control.hosting.goal_server import FEEDBACK_RATE_HZ, GoalServer
from humanoid_control.hosting.gripper_command import GripperCommandServer
from humanoid_control.hosting.rate_limiter import RateLimiter
from humanoid_control.hosting.refusals import Refusals
from humanoid_control.hosting.robot_control import RobotControl
from humanoid_control.hosting.topics.filling import topic
from rclpy.node import Node


class ControllerActions:
    """
    Action servers `follow_joint_trajectory` and `gripper_cmd`, in the controller namespaces.

    Parameters
    ----------
    node
        The node that offers them.
    robot
        Name of the robot, which is its namespace; empty if it is alone.
    control
        The control of the robot, whose controllers run the goals.

    """

    def __init__(self, node: Node, robot: str, control: RobotControl) -> None:
        refusals = Refusals(node.get_logger().warning)
        self._servers: list[GoalServer[Any, Any]] = []
        for name, limb in control.trajectory_controllers.items():
            action = topic(robot, f'{name}/follow_joint_trajectory')
            self._servers.append(
                FollowJointTrajectoryServer(node, action, control, limb, refusals)
            )
        for name, gripper in control.gripper_controllers.items():
            action = topic(robot, f'{name}/gripper_cmd')
            self._servers.append(GripperCommandServer(node, action, control, gripper, refusals))
        self._due = RateLimiter(FEEDBACK_RATE_HZ)

    def tell(self, time_s: float) -> None:
        """
        Update the time of the action servers, and publish feedback of their goals at its rate.

        Parameters
        ----------
        time_s
            The robot's time, that of the newest observation.

        """
        is_due = self._due.is_due(time_s)
        for server in self._servers:
            server.time_s = time_s
            if is_due:
                server.publish_feedback()
