# SPDX-License-Identifier: Apache-2.0
"""Publishers of the walk: its state, its planned footsteps and its balance (DCM and ZMP)."""

from __future__ import annotations

import math

from geometry_msgs.msg import PointStamped
from humanoid_common.qos import LATCHED, STATE
from humanoid_control.hosting.topics.filling import fill_stamp, topic
from humanoid_control.walking.foot_shape import FootShape
from humanoid_control.walking.footsteps import Footstep
from humanoid_control.walking.sides import LEFT, outwards, SIDES
from humanoid_control.walking.status import WalkStatus
from rclpy.node import Node
from std_msgs.msg import ColorRGBA, String
from visualization_msgs.msg import Marker, MarkerArray

LEFT_COLOR = ColorRGBA(r=0.2, g=0.8, b=0.3, a=0.7)
RIGHT_COLOR = ColorRGBA(r=0.9, g=0.4, b=0.2, a=0.7)
THICK_M = 0.004
LIFETIME_S = 1
"""Footsteps vanish after this time without an update."""


class WalkingStateTopic:
    """
    Publisher of `walking_state`: on each change, latched for late-joining subscribers.

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

    def publish(self, state: str) -> None:
        """
        Publish the walking state if it has changed.

        Parameters
        ----------
        state
            The phase of the walk, `blocked`, or the mode in which the robot does not walk.

        """
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
