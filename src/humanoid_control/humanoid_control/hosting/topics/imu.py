# SPDX-License-Identifier: Apache-2.0
"""Say what the inertial sensor measures."""

from __future__ import annotations

from humanoid_common.qos import SENSOR
from humanoid_control.backends import Observation
from humanoid_control.hosting.topics.filling import (
    fill_quaternion,
    fill_stamp,
    fill_vector,
    topic,
)
from rclpy.node import Node
from sensor_msgs.msg import Imu


class ImuTopic:
    """The topic `imu/data`; zero covariances mean that they are not known (REP-145)."""

    def __init__(self, node: Node, robot: str, prefix: str) -> None:
        """Prepare the message."""
        self._message = Imu()
        self._message.header.frame_id = f'{prefix}imu_link'
        self._publisher = node.create_publisher(Imu, topic(robot, 'imu/data'), SENSOR)

    def publish(self, observation: Observation) -> None:
        """Publish what was observed."""
        message = self._message
        fill_stamp(message.header.stamp, observation.time_s)
        fill_quaternion(message.orientation, observation.orientation)
        fill_vector(message.angular_velocity, observation.angular_velocity_rad_s)
        fill_vector(message.linear_acceleration, observation.linear_acceleration_m_s2)
        self._publisher.publish(message)
