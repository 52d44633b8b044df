# SPDX-License-Identifier: Apache-2.0
"""Show the goals of a robot: an arrow for each, and a number if there are several."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Any, TYPE_CHECKING

from geometry_msgs.msg import PoseStamped
from nav2_rviz_plugins.progress import Goal, TO_POSE, WAYPOINTS
from nav2_util.qos import LATCHED
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['WaypointDisplay', 'waypoint_markers']

NAMESPACE = 'waypoints'
ARROW_M = (0.4, 0.08, 0.08)
DISC_M = (0.24, 0.24, 0.02)
TEXT_M = 0.22
TEXT_ABOVE_M = 0.35

WAITING = (0.16, 0.62, 0.95)
CURRENT = (0.20, 0.80, 0.30)
MISSED = (0.95, 0.30, 0.25)


class WaypointDisplay:
    """
    Publisher of the markers of waypoints, or of a single goal in progress, when they change.

    Parameters
    ----------
    node
        The node that publishes.
    topic
        The topic of the markers.

    """

    def __init__(self, node: Node, topic: str) -> None:
        self.markers = MarkerArray()
        """The markers that were published last."""
        self._key: Any = None
        self._node = node
        self._publisher = node.create_publisher(MarkerArray, topic, LATCHED)

    def update(
        self, waypoints: Sequence[PoseStamped], sent: Sequence[PoseStamped], goal: Goal | None
    ) -> None:
        """
        Publish the markers if they have changed.

        Parameters
        ----------
        waypoints
            The collected waypoints.
        sent
            The poses of the goal that was sent last.
        goal
            The newest goal of all actions, of any client.

        """
        current: int | None = None
        missed: list[int] = []
        if goal is not None and goal.is_own and goal.action == WAYPOINTS:
            missed = goal.missed
            if not goal.phase.is_over:
                current = int(goal.numbers.get('current_waypoint', 0))
        poses = waypoints
        is_single = not poses and goal is not None and goal.is_own and goal.action == TO_POSE
        if is_single and goal is not None and not goal.phase.is_over:
            poses = sent
        key = [id(each) for each in poses], current, list(missed), is_single
        if key == self._key:
            return
        self._key = key
        self.markers = waypoint_markers(poses, not is_single, current, missed)
        self._publisher.publish(self.markers)

    def close(self) -> None:
        """Stop publishing."""
        self._node.destroy_publisher(self._publisher)


def waypoint_markers(
    poses: Sequence[PoseStamped],
    is_numbered: bool = True,
    current: int | None = None,
    missed: Collection[int] = (),
) -> MarkerArray:
    """
    Make the markers of goals, which replace the previous ones.

    Parameters
    ----------
    poses
        The goals, each in its own frame.
    is_numbered
        Whether each has a number, from 1.
    current, missed
        The index of the current goal, and the indices of the missed ones, from 0.

    """
    markers = [Marker(ns=NAMESPACE, action=Marker.DELETEALL)]
    for index, pose in enumerate(poses):
        color = MISSED if index in missed else CURRENT if index == current else WAITING
        markers += _markers_of(index, pose, color, is_numbered)
    return MarkerArray(markers=markers)


def _markers_of(index: int, pose: PoseStamped, color: Any, is_numbered: bool) -> list[Marker]:
    kinds = [(Marker.ARROW, ARROW_M), (Marker.CYLINDER, DISC_M)]
    if is_numbered:
        kinds.append((Marker.TEXT_VIEW_FACING, (0.0, 0.0, TEXT_M)))
    return [
        _marker(3 * index + place, kind, scale, pose, color, str(index + 1))
        for place, (kind, scale) in enumerate(kinds)
    ]


def _marker(
    number: int, kind: int, scale: Any, pose: PoseStamped, color: Any, text: str
) -> Marker:
    marker = Marker(ns=NAMESPACE, id=number, type=kind, action=Marker.ADD)
    marker.header.frame_id = pose.header.frame_id  # zero stamp: the newest transform
    at, turn = marker.pose.position, marker.pose.orientation
    at.x, at.y, at.z = pose.pose.position.x, pose.pose.position.y, pose.pose.position.z
    given = pose.pose.orientation
    turn.x, turn.y, turn.z, turn.w = given.x, given.y, given.z, given.w
    at.z += 0.02
    marker.scale.x, marker.scale.y, marker.scale.z = scale
    red, green, blue = color
    marker.color = ColorRGBA(r=red, g=green, b=blue, a=1.0)
    if kind == Marker.TEXT_VIEW_FACING:
        marker.text = text
        at.z += TEXT_ABOVE_M
        marker.color = ColorRGBA(r=1.0, g=1.0, b=1.0, a=1.0)
    return marker
