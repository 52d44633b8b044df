# SPDX-License-Identifier: Apache-2.0
"""Publishers of the walk: its state, footsteps, balance (DCM and ZMP) and odometry."""

from __future__ import annotations

import math

from geometry_msgs.msg import PointStamped, TransformStamped
from humanoid_common.qos import LATCHED, STATE
from humanoid_control.backends import Array
from humanoid_control.hosting.topics.filling import fill_quaternion, fill_stamp, fill_vector, topic
from humanoid_control.walking.footsteps import Footstep
from humanoid_control.walking.odometry import Odometry as WalkOdometry
from humanoid_control.walking.planar import LEFT, outwards, SIDES
from humanoid_control.walking.support_polygon import FootShape
from humanoid_control.walking.walk import WalkStatus
from humanoid_description.rotations import about_z, from_quaternion, quaternion_of
from nav_msgs.msg import Odometry
import numpy as np
from rclpy.node import Node
from std_msgs.msg import Bool, ColorRGBA, String
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

LEFT_COLOR = ColorRGBA(r=0.2, g=0.8, b=0.3, a=0.7)
RIGHT_COLOR = ColorRGBA(r=0.9, g=0.4, b=0.2, a=0.7)
THICK_M = 0.004
LIFETIME_S = 1
"""Footsteps vanish after this time without an update."""
ODOM, BASE, FOOTPRINT = 'odom', 'base_link', 'base_footprint'
_DIAGONAL = slice(0, 36, 7)
_TWIST = (1e-2, 1e-2, 1e-2, 1e-3, 1e-3, 1e-3)
"""Variances of the velocities, m2/s2 and rad2/s2."""


class WalkingStateTopic:
    """
    Publishers of `walking_state` and `gets_up_by_itself`: on each change, latched.

    Parameters
    ----------
    node
        The node that publishes it.
    robot
        Name of the robot, which is its namespace; empty if it is alone.

    """

    def __init__(self, node: Node, robot: str) -> None:
        self._publisher = node.create_publisher(String, topic(robot, 'walking_state'), LATCHED)
        self._said = ''
        self._up_publisher = node.create_publisher(
            Bool, topic(robot, 'gets_up_by_itself'), LATCHED
        )
        self._will_get_up: bool | None = None

    def publish(self, state: str, will_get_up: bool) -> None:
        """
        Publish the walking state, and what happens after a fall, if they have changed.

        Parameters
        ----------
        state
            The phase of the walk, `blocked`, or the mode in which the robot does not walk.
        will_get_up
            Whether the robot lies on the ground and is to get up by itself soon.

        """
        if will_get_up is not self._will_get_up:
            self._will_get_up = will_get_up
            self._up_publisher.publish(Bool(data=will_get_up))
        if state != self._said:
            self._said = state
            self._publisher.publish(String(data=state))


class BalanceTopics:
    """
    Publishers of `walking/dcm`, which is measured, and `walking/zmp`, which is commanded.

    Parameters
    ----------
    node
        The node that publishes them.
    robot
        Name of the robot, which is its namespace; empty if it is alone.
    frame
        Name of its odom frame, with the prefix.

    """

    def __init__(self, node: Node, robot: str, frame: str) -> None:
        self._message = PointStamped()
        self._message.header.frame_id = frame
        self._dcm, self._zmp = (
            node.create_publisher(PointStamped, topic(robot, f'walking/{name}'), STATE)
            for name in ('dcm', 'zmp')
        )

    def publish(self, time_s: float, status: WalkStatus) -> None:
        """
        Publish the measured DCM and the commanded ZMP, both on the ground.

        Parameters
        ----------
        time_s
            The time that stamps the messages.
        status
            The walk, with both points in the odom frame.

        """
        fill_stamp(self._message.header.stamp, time_s)
        for publisher, point_m in ((self._dcm, status.dcm_m), (self._zmp, status.zmp_m)):
            self._message.point.x, self._message.point.y = point_m.real, point_m.imag
            publisher.publish(self._message)


class FootstepsTopic:
    """
    Publisher of `footsteps`: the planned landings of the load-bearing parts of the soles.

    Parameters
    ----------
    node
        The node that publishes it.
    robot
        Name of the robot, which is its namespace; empty if it is alone.
    frame
        Name of its odom frame, with the prefix.
    foot
        The rectangle of the left sole that is drawn; the right one mirrors it.

    """

    def __init__(self, node: Node, robot: str, frame: str, foot: FootShape) -> None:
        self._frame, self._foot = frame, foot
        self._publisher = node.create_publisher(MarkerArray, topic(robot, 'footsteps'), STATE)

    def publish(self, time_s: float, status: WalkStatus) -> None:
        """
        Publish the planned footsteps as markers, which replace those published before.

        Parameters
        ----------
        time_s
            The time that stamps the markers.
        status
            The walk, with the planned landings in the odom frame.

        """
        clear = Marker(action=Marker.DELETEALL)
        clear.header.frame_id = self._frame
        steps = [self._marker(time_s, *step) for step in enumerate(status.footsteps)]
        self._publisher.publish(MarkerArray(markers=[clear, *steps]))

    def _marker(self, time_s: float, number: int, step: Footstep) -> Marker:
        """
        Build the marker of a footstep: a thin plate.

        Left and right steps alternate and have ids of their own, so that a marker keeps its
        colour.
        """
        own = number - number % len(SIDES) + step.side
        marker = Marker(ns='footsteps', id=own, type=Marker.CUBE)
        marker.header.frame_id = self._frame
        fill_stamp(marker.header.stamp, time_s)
        marker.lifetime.sec = LIFETIME_S
        foot = self._foot
        left_m = outwards(step.side) * (foot.outer_m + foot.inner_m) / 2.0
        position_m = step.pose.at((foot.front_m + foot.back_m) / 2.0, left_m)
        marker.pose.position.x, marker.pose.position.y = position_m.real, position_m.imag
        marker.pose.orientation.z = math.sin(step.pose.yaw_rad / 2.0)
        marker.pose.orientation.w = math.cos(step.pose.yaw_rad / 2.0)
        marker.scale.x, marker.scale.y = foot.front_m - foot.back_m, foot.outer_m - foot.inner_m
        marker.scale.z = THICK_M
        marker.color = LEFT_COLOR if step.side == LEFT else RIGHT_COLOR
        return marker


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
