# SPDX-License-Identifier: Apache-2.0
"""Publishers of the odometry and its transforms."""

from __future__ import annotations

from geometry_msgs.msg import TransformStamped
from humanoid_common.qos import STATE
from humanoid_control.backends import Array
from humanoid_control.dynamics.rotations import about_z, from_quaternion
from humanoid_control.hosting.topics.filling import (
    fill_quaternion,
    fill_stamp,
    fill_vector,
    topic,
)
from humanoid_control.walking.heading import quaternion_of
from humanoid_control.walking.odometry import Odometry as WalkOdometry
from nav_msgs.msg import Odometry
import numpy as np
from rclpy.node import Node
from tf2_msgs.msg import TFMessage

ODOM, BASE, FOOTPRINT = 'odom', 'base_link', 'base_footprint'
_DIAGONAL = slice(0, 36, 7)
_TWIST = (1e-2, 1e-2, 1e-2, 1e-3, 1e-3, 1e-3)
"""Variances of the velocities, m2/s2 and rad2/s2."""


class OdometryTopics:
    """
    Publishers of `odom` and `tf`: the pose of the base, and the footprint on the ground.

    The footprint is level on the ground under the base, with the heading of the base, as in
    REP-120.

    Parameters
    ----------
    node
        The node that publishes them.
    robot
        Name of the robot, which is its namespace; empty if it is alone.
    prefix
        Prefix of the frame names.

    """

    def __init__(self, node: Node, robot: str, prefix: str) -> None:
        self._odometry = Odometry()
        self._odometry.header.frame_id = prefix + ODOM
        self._odometry.child_frame_id = prefix + BASE
        self._base = _transform(prefix + ODOM, prefix + BASE)
        self._footprint = _transform(prefix + BASE, prefix + FOOTPRINT)
        self._transforms = TFMessage(transforms=[self._base, self._footprint])
        self._odometry_publisher = node.create_publisher(Odometry, topic(robot, 'odom'), STATE)
        self._tf_publisher = node.create_publisher(TFMessage, topic(robot, 'tf'), STATE)

    def publish(self, time_s: float, odometry: WalkOdometry) -> None:
        """
        Publish the odometry, and the transforms odom -> base_link -> base_footprint.

        Parameters
        ----------
        time_s
            The time that stamps the messages.
        odometry
            Pose of the base in the odom frame, its covariance, and the velocity in base_link.

        """
        position_m = odometry.pose.position_m
        position = np.array([position_m.real, position_m.imag, odometry.height_m])
        orientation = np.array(odometry.orientation)
        self._fill_odometry(time_s, odometry, position, orientation)
        fill_stamp(self._base.header.stamp, time_s)
        fill_vector(self._base.transform.translation, position)
        fill_quaternion(self._base.transform.rotation, orientation)
        self._fill_footprint(time_s, odometry, orientation)
        self._odometry_publisher.publish(self._odometry)
        self._tf_publisher.publish(self._transforms)

    def _fill_odometry(
        self, time_s: float, odometry: WalkOdometry, position: Array, orientation: Array
    ) -> None:
        """Write the pose and the twist, with their covariances."""
        message = self._odometry
        fill_stamp(message.header.stamp, time_s)
        fill_vector(message.pose.pose.position, position)
        fill_quaternion(message.pose.pose.orientation, orientation)
        fill_vector(message.twist.twist.linear, odometry.linear_velocity_m_s)
        fill_vector(message.twist.twist.angular, odometry.angular_velocity_rad_s)
        message.pose.covariance[:] = odometry.covariance.ravel()
        message.twist.covariance[_DIAGONAL] = _TWIST

    def _fill_footprint(self, time_s: float, odometry: WalkOdometry, orientation: Array) -> None:
        """Write the transform from the base to the footprint on the ground."""
        to_base = from_quaternion(orientation).T
        turn = quaternion_of(to_base @ about_z(odometry.pose.yaw_rad))
        fill_stamp(self._footprint.header.stamp, time_s)
        fill_vector(self._footprint.transform.translation, -odometry.height_m * to_base[:, 2])
        fill_quaternion(self._footprint.transform.rotation, np.array(turn))


def _transform(parent: str, child: str) -> TransformStamped:
    """Create the message of a transform between two frames."""
    transform = TransformStamped(child_frame_id=child)
    transform.header.frame_id = parent
    return transform
