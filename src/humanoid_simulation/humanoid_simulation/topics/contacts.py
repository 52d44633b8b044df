# SPDX-License-Identifier: Apache-2.0
"""Publisher of the contacts of a robot."""

from __future__ import annotations

from collections.abc import Iterable

from humanoid_common.qos import SENSOR
from humanoid_control.hosting.topics.filling import fill_stamp, topic
from humanoid_interfaces.msg import Contacts
from humanoid_simulation.backend import Contact
from humanoid_simulation.conversions import contact_message
from humanoid_simulation.topics.ground_truth import WORLD
from rclpy.node import Node


class ContactsTopic:
    """
    Publisher of the topic `contacts` of a robot, in world axes.

    Parameters
    ----------
    node
        The node that publishes it.
    robot
        Namespace of the robot, relative to that of the node; '' if it is alone.
    links
        Names of the bodies of the robot, as `MujocoBackend.links` returns them.

    """

    def __init__(self, node: Node, robot: str, links: Iterable[str]) -> None:
        self._links = frozenset(links)
        self._publisher = node.create_publisher(Contacts, topic(robot, 'contacts'), SENSOR)

    @property
    def is_wanted(self) -> bool:
        """Whether the topic has subscribers."""
        return bool(self._publisher.get_subscription_count())

    def publish(self, time_s: float, contacts: Iterable[Contact]) -> None:
        """
        Publish the contacts of the robot.

        Parameters
        ----------
        time_s
            Simulated time, for the stamp.
        contacts
            All contacts of the world; those without a link of the robot are left out.

        """
        message = Contacts()
        message.header.frame_id = WORLD
        fill_stamp(message.header.stamp, time_s)
        message.contacts = [
            contact_message(contact)
            for contact in contacts
            if contact.body1 in self._links or contact.body2 in self._links
        ]
        self._publisher.publish(message)
