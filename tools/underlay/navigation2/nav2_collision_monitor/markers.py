# SPDX-License-Identifier: Apache-2.0
"""Publish the points of each sensor as a marker for RViz."""

from __future__ import annotations

from collections.abc import Mapping

from geometry_msgs.msg import Point
from nav2_collision_monitor.shapes import FloatArray
from nav2_util import LifecycleNode
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

__all__ = ['PointMarkers']

_SIZE_M = 0.02
_MOST_POINTS = 5000


class PointMarkers:
    """
    Publisher of sensor points on `~/collision_points_marker`, if it has subscribers.

    Parameters
    ----------
    node
        The node that publishes.
    frame
        The frame of the points.

    """

    def __init__(self, node: LifecycleNode, frame: str) -> None:
        self._frame = frame
        self._publisher = node.create_publisher(MarkerArray, '~/collision_points_marker', 1)

    def publish(self, points: Mapping[str, FloatArray]) -> None:
        """
        Publish a marker for each sensor, downsampled to at most 5000 points.

        Parameters
        ----------
        points
            Points (N, 2) in m, in the frame of the markers, by sensor name.

        """
        if not self._publisher.get_subscription_count():
            return
        message = MarkerArray()
        for name, each in points.items():
            marker = Marker(ns=f'collision_points_{name}', type=Marker.POINTS)
            marker.header.frame_id = self._frame
            marker.action, marker.frame_locked = Marker.ADD, True
            marker.pose.orientation.w = 1.0
            marker.scale.x = marker.scale.y = _SIZE_M
            marker.color = ColorRGBA(r=1.0, a=1.0)
            shown = each[:: len(each) // _MOST_POINTS + 1]
            marker.points = [Point(x=x, y=y) for x, y in shown.tolist()]
            message.markers.append(marker)
        self._publisher.publish(message)
