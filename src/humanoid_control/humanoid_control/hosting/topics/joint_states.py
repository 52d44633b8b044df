# SPDX-License-Identifier: Apache-2.0
"""Publisher of the joint states."""

from __future__ import annotations

from collections.abc import Sequence

from humanoid_common.qos import STATE
from humanoid_control.backends import Observation
from humanoid_control.hosting.topics.filling import fill_stamp, topic, view
from rclpy.node import Node
from sensor_msgs.msg import JointState


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
