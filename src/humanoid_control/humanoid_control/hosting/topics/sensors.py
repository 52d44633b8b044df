# SPDX-License-Identifier: Apache-2.0
"""Publishers of the joint states and of the IMU measurements."""

from __future__ import annotations

from collections.abc import Sequence

from humanoid_common.qos import SENSOR, STATE
from humanoid_control.backends import ImuNoise, Observation
from humanoid_control.hosting.topics.filling import (
    fill_quaternion,
    fill_stamp,
    fill_vector,
    topic,
    view,
)
from rclpy.node import Node
from sensor_msgs.msg import Imu, JointState

_DIAGONAL = slice(0, 9, 4)
_HEADING = 8


class JointStatesTopic:
    """
    Publisher of `joint_states`.

    Parameters
    ----------
    node
        The node that publishes it.
    robot
        Name of the robot, which is its namespace; empty if it is alone.
    joints
        All n joints, in the order of the observations.

    """

    def __init__(self, node: Node, robot: str, joints: Sequence[str]) -> None:
        zeros = [0.0] * len(joints)
        self._message = JointState(name=list(joints), position=zeros, velocity=zeros, effort=zeros)
        self._position = view(self._message.position)
        self._velocity = view(self._message.velocity)
        self._effort = view(self._message.effort)
        self._publisher = node.create_publisher(JointState, topic(robot, 'joint_states'), STATE)

    def publish(self, observation: Observation) -> None:
        """
        Publish the positions, velocities and efforts of all joints.

        Parameters
        ----------
        observation
            The observation, with its joints in the order of the topic; its time is the stamp.

        """
        fill_stamp(self._message.header.stamp, observation.time_s)
        self._position[:] = observation.positions_rad
        self._velocity[:] = observation.velocities_rad_s
        self._effort[:] = observation.efforts_nm
        self._publisher.publish(self._message)


class ImuTopic:
    """
    Publisher of `imu/data`.

    Covariances are those of the sensor; zero means unknown (REP-145). The variance of the heading
    grows with the time since the start, as no magnetometer corrects it.

    Parameters
    ----------
    node
        The node that publishes it.
    robot
        Name of the robot, which is its namespace; empty if it is alone.
    prefix
        Prefix of the name of the frame, imu_link.
    noise
        Standard deviations of the sensor, from which the covariances follow.

    """

    def __init__(self, node: Node, robot: str, prefix: str, noise: ImuNoise) -> None:
        self._noise = noise
        self._start_s: float | None = None
        self._message = Imu()
        for covariance, deviation in (
            (self._message.orientation_covariance, noise.tilt_rad),
            (self._message.angular_velocity_covariance, noise.angular_velocity_rad_s),
            (self._message.linear_acceleration_covariance, noise.acceleration_m_s2),
        ):
            covariance[_DIAGONAL] = deviation**2
        self._message.header.frame_id = f'{prefix}imu_link'
        self._publisher = node.create_publisher(Imu, topic(robot, 'imu/data'), SENSOR)

    def publish(self, observation: Observation) -> None:
        """
        Publish the measurements of the IMU, in the frame imu_link.

        Parameters
        ----------
        observation
            The observation; its time stamps the message.

        """
        message = self._message
        fill_stamp(message.header.stamp, observation.time_s)
        fill_quaternion(message.orientation, observation.orientation)
        fill_vector(message.angular_velocity, observation.angular_velocity_rad_s)
        message.orientation_covariance[_HEADING] = self._heading_rad2(observation.time_s)
        fill_vector(message.linear_acceleration, observation.linear_acceleration_m_s2)
        self._publisher.publish(message)

    def _heading_rad2(self, time_s: float) -> float:
        """Compute the variance of the heading at a time."""
        if self._start_s is None:
            self._start_s = time_s
        return self._noise.heading_variance_rad2(max(time_s - self._start_s, 0.0))
