# SPDX-License-Identifier: Apache-2.0
"""Publisher of the wrenches of the ground on the feet of a robot."""

from __future__ import annotations

from geometry_msgs.msg import WrenchStamped
from humanoid_common.qos import SENSOR
from humanoid_control.backends import Observation
from humanoid_control.hosting.topics.filling import fill_stamp, fill_vector, topic
from rclpy.node import Node

SOLES = ('l_sole', 'r_sole')


class WrenchTopics:
    """
    Publisher of `l_sole/wrench` and `r_sole/wrench`, about the sole and in its axes.

    Parameters
    ----------
    node
        The node that publishes them.
    robot
        Namespace of the robot, relative to that of the node; '' if it is alone.
    prefix
        Prefix of the frames `l_sole` and `r_sole`.

    """

    def __init__(self, node: Node, robot: str, prefix: str) -> None:
        self._messages = [WrenchStamped(), WrenchStamped()]
        for message, sole in zip(self._messages, SOLES):
            message.header.frame_id = prefix + sole
        self._publishers = [
            node.create_publisher(WrenchStamped, topic(robot, f'{sole}/wrench'), SENSOR)
            for sole in SOLES
        ]

    def publish(self, observation: Observation) -> None:
        """
        Publish the measured wrenches of the ground on both feet.

        Parameters
        ----------
        observation
            A measurement of the robot; its time is the stamp.

        """
        for foot, (message, publisher) in enumerate(zip(self._messages, self._publishers)):
            fill_stamp(message.header.stamp, observation.time_s)
            fill_vector(message.wrench.force, observation.foot_forces_n[foot])
            fill_vector(message.wrench.torque, observation.foot_torques_nm[foot])
            publisher.publish(message)
