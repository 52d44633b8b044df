# SPDX-License-Identifier: Apache-2.0
"""Let a turtle move as another one does."""

from __future__ import annotations

from geometry_msgs.msg import Twist
from rclpy.node import Node
from turtlesim.msg import Pose

__all__ = ['MimicNode']

DEPTH = 10


class MimicNode(Node):
    """Node that makes commands of the velocities of a turtle: `input/pose` to `output/cmd_vel`."""

    def __init__(self) -> None:
        super().__init__('turtle_mimic')
        self._commands = self.create_publisher(Twist, 'output/cmd_vel', DEPTH)
        self.create_subscription(Pose, 'input/pose', self._on_pose, DEPTH)

    def _on_pose(self, pose: Pose) -> None:
        command = Twist()
        command.linear.x = pose.linear_velocity
        command.angular.z = pose.angular_velocity
        self._commands.publish(command)
