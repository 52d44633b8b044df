# SPDX-License-Identifier: Apache-2.0
"""Let the first turtle draw a square."""

from __future__ import annotations

from typing import Any

from geometry_msgs.msg import Twist
import numpy as np
from rclpy.node import Node
from std_srvs.srv import Empty
from turtlesim.msg import Pose
from turtlesim_py.square import Square

__all__ = ['DrawSquareNode']

DEPTH = 1
PERIOD_S = 0.5
REPEAT_PERIOD_S = 2.0
WAITING_PERIOD_S = 5.0


class DrawSquareNode(Node):
    """Node that resets turtlesim, and then leads its turtle round a square until it is ended."""

    def __init__(self) -> None:
        super().__init__('draw_square')
        self._square: Square | None = None
        self._commands = self.create_publisher(Twist, 'turtle1/cmd_vel', DEPTH)
        self._reset = self.create_client(Empty, 'reset')
        self.create_subscription(Pose, 'turtle1/pose', self._on_pose, DEPTH)
        self._timer = self.create_timer(PERIOD_S, self._ask)
        self._ask()

    def _ask(self) -> None:
        """Ask for a reset as soon as somebody offers it, repeatedly if the response is lost."""
        if self._reset.service_is_ready():
            self._timer.timer_period_ns = int(REPEAT_PERIOD_S * 1e9)
            self._timer.reset()
            self._reset.call_async(Empty.Request()).add_done_callback(self._begin)
        else:
            self.get_logger().info(
                f'Waiting for the service {self._reset.srv_name} of turtlesim_node',
                throttle_duration_sec=WAITING_PERIOD_S,
            )

    def _begin(self, _: Any) -> None:
        self._timer.cancel()
        self._square = Square()
        self._report()

    def _on_pose(self, pose: Pose) -> None:
        if self._square is None:
            return
        before = self._square.corner
        velocity = self._square.velocity_at(pose.x, pose.y, pose.theta)
        command = Twist()
        command.linear.x = velocity.forward
        command.angular.z = velocity.turn
        self._commands.publish(command)
        if self._square.corner != before:
            self.get_logger().info('Reached goal')
            self._report()

    def _report(self) -> None:
        if self._square is not None:
            x, y, heading = np.array([*self._square.corner, self._square.heading], np.float32)
            self.get_logger().info(f'New goal [{x:f} {y:f}, {heading:f}]')
