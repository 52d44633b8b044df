# SPDX-License-Identifier: Apache-2.0
"""Publish the truth about each robot: odometry, contacts, foot wrenches and the world frame."""

from __future__ import annotations

from collections.abc import Iterable
import math

from geometry_msgs.msg import Point, TransformStamped, Vector3, WrenchStamped
from humanoid_common.qos import SENSOR, STATE
from humanoid_control.backends import Array, Observation
from humanoid_control.hosting.topics.filling import fill_quaternion, fill_stamp, fill_vector, topic
from humanoid_control.hosting.topics.walk import ODOM
from humanoid_control.walking.odometry import Odometry
from humanoid_description.rotations import quaternion_from_rpy
from humanoid_interfaces.msg import Contact as ContactMessage
from humanoid_interfaces.msg import Contacts
from humanoid_simulation.backend.forces import Contact
from humanoid_simulation.backend.state import EntityState
from humanoid_simulation.quaternions import inverse, product, rotated
from humanoid_simulation.scene.scene import WORLD
from nav_msgs.msg import Odometry as OdometryMessage
import numpy as np
from rclpy.node import Node
from tf2_msgs.msg import TFMessage

SOLES = ('l_sole', 'r_sole')
_LEAST_M, _LEAST_HEIGHT_M, _LEAST_RAD = 0.005, 0.02, 0.005


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
        self._message = OdometryMessage()
        self._message.header.frame_id = WORLD
        self._message.child_frame_id = f'{prefix}base_link'
        self._publisher = node.create_publisher(
            OdometryMessage, topic(robot, 'ground_truth/odom'), STATE
        )

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


class WorldFrame:
    """
    Publisher of the true transform from `odom` to `world`, for viewers; no robot could know it.

    Like the odometry, it is a rotation about the vertical and a translation. It is repeated
    unchanged until the odometry is visibly off, so that a viewer need not move the whole world at
    each step.

    Parameters
    ----------
    node
        The node that publishes it.
    robot
        Namespace of the robot, relative to that of the node; '' if it is alone.
    prefix
        Prefix of the frame `odom`.

    """

    def __init__(self, node: Node, robot: str, prefix: str) -> None:
        self._transform = TransformStamped(child_frame_id=WORLD)
        self._transform.header.frame_id = prefix + ODOM
        self._message = TFMessage(transforms=[self._transform])
        self._publisher = node.create_publisher(TFMessage, topic(robot, 'tf'), STATE)
        self._at = math.inf, math.inf, math.inf, math.inf

    def publish(self, time_s: float, odometry: Odometry, truth: EntityState, age_s: float) -> None:
        """
        Publish the transform from `odom` to `world`, updated if it is visibly off.

        Parameters
        ----------
        time_s
            Simulated time of the odometry, for the stamp.
        odometry
            Where the robot believes it is.
        truth
            True state of its base, in the world frame.
        age_s
            How much older the odometry is than the truth.

        """
        x, y, z, yaw_rad = world_in_odom(odometry, truth, age_s)
        old_x, old_y, old_z, old_yaw_rad = self._at
        turned_rad = math.remainder(yaw_rad - old_yaw_rad, math.tau) if self._is_set else math.inf
        if (
            math.hypot(x - old_x, y - old_y) > _LEAST_M
            or abs(z - old_z) > _LEAST_HEIGHT_M
            or abs(turned_rad) > _LEAST_RAD
        ):
            self._at = x, y, z, yaw_rad
            fill_vector(self._transform.transform.translation, np.array([x, y, z]))
            fill_quaternion(
                self._transform.transform.rotation, quaternion_from_rpy(0.0, 0.0, yaw_rad)
            )
        fill_stamp(self._transform.header.stamp, time_s)
        self._publisher.publish(self._message)

    @property
    def _is_set(self) -> bool:
        """Whether there is a previous transform to compare with."""
        return math.isfinite(self._at[3])


def world_in_odom(
    odometry: Odometry, truth: EntityState, age_s: float = 0.0
) -> tuple[float, float, float, float]:
    """
    Compute the planar pose and the height of the world frame in `odom`.

    Parameters
    ----------
    odometry
        Where the robot believes it is, in `odom`.
    truth
        True state of its base, in the world frame.
    age_s
        How much older the odometry is; the true position is extrapolated back by it.

    Returns
    -------
    tuple[float, float, float, float]
        x, y and z in m, and the yaw in rad.

    """
    turn = product(np.array(odometry.orientation), inverse(truth.orientation))
    yaw_rad = math.atan2(
        2.0 * (turn[0] * turn[3] + turn[1] * turn[2]),
        1.0 - 2.0 * (turn[2] * turn[2] + turn[3] * turn[3]),
    )
    x, y, z = truth.position_m - age_s * truth.linear_velocity_m_s
    cosine, sine = math.cos(yaw_rad), math.sin(yaw_rad)
    believed_m = odometry.pose.position_m
    return (
        believed_m.real - (cosine * x - sine * y),
        believed_m.imag - (sine * x + cosine * y),
        odometry.height_m - z,
        yaw_rad,
    )


def contact_message(contact: Contact) -> ContactMessage:
    """
    Convert a contact to its message, in world axes like the contact.

    Parameters
    ----------
    contact
        A contact of the simulated world.

    """
    x, y, z = contact.position_m.tolist()
    return ContactMessage(
        body1=contact.body1,
        body2=contact.body2,
        position=Point(x=x, y=y, z=z),
        normal=_vector_message(contact.normal),
        force=_vector_message(contact.force_n),
    )


def _vector_message(values: Array) -> Vector3:
    """Convert an array (3,) to a Vector3 message."""
    x, y, z = values.tolist()
    return Vector3(x=x, y=y, z=z)
