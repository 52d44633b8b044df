# SPDX-License-Identifier: Apache-2.0
"""A node that lets a second turtle follow a frame."""

from __future__ import annotations

from collections.abc import Sequence
import math
import sys
from typing import Any

from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.task import Future
from rclpy.time import Time
from tf2_ros import Buffer, TransformException, TransformListener
from tf2_ros.program import run_node
from turtlesim.srv import Spawn

__all__ = ['FrameListener', 'main']

FOLLOWER = 'turtle2'
START = {'x': 4.0, 'y': 2.0, 'theta': 0.0}
TURN_GAIN, WALK_GAIN = 1.0, 0.5
"""Of the velocities, per rad of bearing and per m of distance."""
PERIOD_S = 1.0


class FrameListener(Node):
    """
    Spawns `turtle2`, and drives it towards a frame, as seen from the turtle.

    The parameter `target_frame` names the frame.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('turtle_tf2_frame_listener', **options)
        self.target_frame = self.declare_parameter('target_frame', 'turtle1').value
        self.tf_buffer = Buffer()
        self.tf_listener = TransformListener(self.tf_buffer, self)
        self._spawner = self.create_client(Spawn, 'spawn')
        self._spawning: Future | None = None
        self._is_spawned = False
        self._velocity = self.create_publisher(Twist, f'{FOLLOWER}/cmd_vel', 1)
        self.create_timer(PERIOD_S, self.on_timer)

    def on_timer(self) -> None:
        """Spawn the turtle, and once it is there, drive it."""
        if self._is_spawned:
            self._follow()
        elif self._spawning is None:
            if self._spawner.service_is_ready():
                request = Spawn.Request(name=FOLLOWER, **START)
                self._spawning = self._spawner.call_async(request)
            else:
                self.get_logger().info('Service is not ready')
        elif self._spawning.done():
            self._is_spawned = True
            # The name is empty if there was such a turtle already, which is driven then.
            name = self._spawning.result().name or FOLLOWER
            self.get_logger().info(f'Successfully spawned {name}')
        else:
            self.get_logger().info('Spawn is not finished')

    def _follow(self) -> None:
        """Command velocities towards the frame."""
        try:
            found = self.tf_buffer.lookup_transform(FOLLOWER, self.target_frame, Time())
        except TransformException as error:
            self.get_logger().info(
                f'Could not transform {FOLLOWER} to {self.target_frame}: {error}'
            )
            return
        target = found.transform.translation
        command = Twist()
        command.angular.z = TURN_GAIN * math.atan2(target.y, target.x)
        command.linear.x = WALK_GAIN * math.hypot(target.x, target.y)
        self._velocity.publish(command)


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: FrameListener(), args)


if __name__ == '__main__':
    sys.exit(main())
