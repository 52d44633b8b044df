# SPDX-License-Identifier: Apache-2.0
"""Publisher of the true odometry of a robot."""

from __future__ import annotations

from humanoid_common.qos import STATE
from humanoid_control.hosting.topics.filling import (
    fill_quaternion,
    fill_stamp,
    fill_vector,
    topic,
)
from humanoid_simulation.backend import EntityState
from humanoid_simulation.rotations import inverse, rotated
from nav_msgs.msg import Odometry
from rclpy.node import Node

WORLD = 'world'


class GroundTruthTopic:
    """
    Publisher of `ground_truth/odom`: pose in the world frame, twist in the axes of the base.

    Parameters
    ----------
    node
        The node that publishes it.
    robot
        Namespace of the robot, relative to that of the node; '' if it is alone.
    prefix
        Prefix of the frame `base_link`.

    """

    def __init__(self, node: Node, robot: str, prefix: str) -> None:
        self._message = Odometry()
        self._message.header.frame_id = WORLD
        self._message.child_frame_id = f'{prefix}base_link'
        self._publisher = node.create_publisher(Odometry, topic(robot, 'ground_truth/odom'), STATE)

    def publish(self, time_s: float, truth: EntityState) -> None:
        """
        Publish the true odometry of the robot.

        Parameters
        ----------
        time_s
            Simulated time, for the stamp.
        truth
            State of base_link, in the world frame.

        """
        message = self._message
        to_base = inverse(truth.orientation)
        fill_stamp(message.header.stamp, time_s)
        fill_vector(message.pose.pose.position, truth.position_m)
        fill_quaternion(message.pose.pose.orientation, truth.orientation)
        fill_vector(message.twist.twist.linear, rotated(truth.linear_velocity_m_s, to_base))
        fill_vector(message.twist.twist.angular, rotated(truth.angular_velocity_rad_s, to_base))
        self._publisher.publish(message)
