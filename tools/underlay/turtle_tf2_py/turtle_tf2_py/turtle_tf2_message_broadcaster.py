# SPDX-License-Identifier: Apache-2.0
"""A node that drives a third turtle, and publishes where it is as stamped points."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

from geometry_msgs.msg import PointStamped, Twist
from rclpy.node import Node
from rclpy.task import Future
from tf2_ros.program import run_node
from turtlesim.msg import Pose
from turtlesim.srv import Spawn

__all__ = ['PointPublisher', 'main']

TURTLE, WORLD = 'turtle3', 'world'
START = {'x': 4.0, 'y': 2.0, 'theta': 0.0}
PERIOD_S = 1.0


class PointPublisher(Node):
    """
    Spawns `turtle3`, drives it on a circle, and publishes its position in `world`.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('turtle_tf2_message_broadcaster', **options)
        self._spawner = self.create_client(Spawn, 'spawn')
        self._spawning: Future | None = None
        self._velocity = self.create_publisher(Twist, f'/{TURTLE}/cmd_vel', 10)
        self._points = self.create_publisher(PointStamped, f'/{TURTLE}/turtle_point_stamped', 10)
        self.create_subscription(Pose, f'/{TURTLE}/pose', self.handle_turtle_pose, 10)
        self.create_timer(PERIOD_S, self.on_timer)

    def on_timer(self) -> None:
        """Spawn the turtle."""
        if self._spawning is None and self._spawner.service_is_ready():
            self._spawning = self._spawner.call_async(Spawn.Request(name=TURTLE, **START))

    def handle_turtle_pose(self, msg: Pose) -> None:
        """
        Publish where the turtle is, and keep it on its circle.

        Parameters
        ----------
        msg
            The pose of the turtle.

        """
        command = Twist()
        command.linear.x = command.angular.z = 1.0
        self._velocity.publish(command)
        point = PointStamped()
        point.header.stamp = self.get_clock().now().to_msg()
        point.header.frame_id = WORLD
        point.point.x, point.point.y = msg.x, msg.y
        self._points.publish(point)


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: PointPublisher(), args)


if __name__ == '__main__':
    sys.exit(main())
