# SPDX-License-Identifier: Apache-2.0
"""A node that broadcasts the pose of a turtle as a frame."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

from rclpy.node import Node
from tf2_ros import TransformBroadcaster
from tf2_ros.program import run_node
from turtle_tf2_py.turtle_frames import planar_transform
from turtlesim.msg import Pose

__all__ = ['FramePublisher', 'main']

WORLD = 'world'


class FramePublisher(Node):
    """
    Broadcasts the transform from `world` to a turtle, for each of its poses.

    The parameter `turtlename` names the turtle, and its frame.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('turtle_tf2_frame_publisher', **options)
        self.turtlename = self.declare_parameter('turtlename', 'turtle').value
        self.tf_broadcaster = TransformBroadcaster(self)
        self.create_subscription(Pose, f'/{self.turtlename}/pose', self.handle_turtle_pose, 1)

    def handle_turtle_pose(self, msg: Pose) -> None:
        """
        Broadcast a pose.

        Parameters
        ----------
        msg
            The pose of the turtle.

        """
        stamp = self.get_clock().now().to_msg()
        self.tf_broadcaster.sendTransform(
            planar_transform(WORLD, self.turtlename, stamp, msg.x, msg.y, msg.theta)
        )


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: FramePublisher(), args)


if __name__ == '__main__':
    sys.exit(main())
