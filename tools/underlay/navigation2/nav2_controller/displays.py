# SPDX-License-Identifier: Apache-2.0
"""Displays of controllers, rate-limited and published only to subscribers."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from geometry_msgs.msg import Point, PointStamped, PoseStamped
from nav2_controller.control import Command, ControlState, FloatArray
from nav2_util.geometry import make_path, make_pose_stamped, make_quaternion, Pose2D
from nav_msgs.msg import Path
import numpy as np
from std_msgs.msg import Bool
from visualization_msgs.msg import Marker, MarkerArray

__all__ = ['DisplayPublisher']

_PERIOD_S = 0.2


class DisplayPublisher:
    """
    Publisher of the paths, points and markers of controllers.

    Parameters
    ----------
    node
        The node that publishes.

    """

    def __init__(self, node: Any) -> None:
        self._node = node
        self._publishers: dict[str, Any] = {}
        for name, kind in (
            ('received_global_plan', Path),
            ('transformed_global_plan', Path),
            ('local_plan', Path),
            ('lookahead_collision_arc', Path),
            ('lookahead_point', PointStamped),
            ('curvature_lookahead_point', PointStamped),
            ('motion_target', PoseStamped),
            ('slowdown', Marker),
            ('is_rotating_to_heading', Bool),
            ('marker', MarkerArray),
            ('trajectories', MarkerArray),
        ):
            self._publishers[name] = node.create_publisher(kind, name, 1)
        self._next_s = 0.0
        self._frame, self._stamp = '', None

    def show_plan(self, path: Path) -> None:
        """
        Publish a path as received, on `received_global_plan`.

        Parameters
        ----------
        path
            The path of a goal, in its own frame.

        """
        self._publish('received_global_plan', path, lambda each: each)

    def show(self, state: ControlState, command: Command, frame: str) -> None:
        """
        Publish the displays of a command, at 5 Hz at most.

        Parameters
        ----------
        state
            The state that the controller received.
        command
            The command that it returned, with its displays.
        frame
            The frame of the costmap, in which both are.

        """
        if self._next_s - _PERIOD_S <= state.now_s < self._next_s:
            return
        self._next_s = state.now_s + _PERIOD_S
        self._frame, self._stamp = frame, self._node.get_clock().now().to_msg()
        shown = command.displays
        self._publish('transformed_global_plan', state.plan, self._path)
        self._publish('local_plan', shown.local_plan, self._path)
        self._publish('lookahead_collision_arc', shown.collision_arc, self._path)
        self._publish('lookahead_point', shown.lookahead, self._point)
        self._publish('curvature_lookahead_point', shown.curvature_lookahead, self._point)
        self._publish('motion_target', shown.motion_target, self._pose)
        self._publish('is_rotating_to_heading', shown.is_rotating, lambda on: Bool(data=on))
        for name in ('marker', 'trajectories'):
            self._publish(name, shown.trajectories, self._trajectories)
        if shown.slowdown_radius_m is not None:
            radius = shown.slowdown_radius_m
            self._publish('slowdown', state.goal, lambda goal: self._circle(goal, radius))

    def _publish(self, topic: str, value: Any, make: Callable[[Any], Any]) -> None:
        if value is not None and self._publishers[topic].get_subscription_count():
            self._publishers[topic].publish(make(value))

    def _path(self, poses: FloatArray) -> Path:
        return make_path(poses, self._frame, self._stamp)

    def _pose(self, pose: Pose2D) -> PoseStamped:
        return make_pose_stamped(pose, self._frame, self._stamp)

    def _point(self, point: tuple[float, float]) -> PointStamped:
        message = PointStamped()
        message.header.frame_id, message.header.stamp = self._frame, self._stamp
        message.point.x, message.point.y = float(point[0]), float(point[1])
        # Above the ground, so that no map hides it.
        message.point.z = 0.01
        return message

    def _marker(self, kind: int, width_m: float) -> Marker:
        marker = Marker(type=kind, action=Marker.ADD, ns='controller')
        marker.header.frame_id, marker.header.stamp = self._frame, self._stamp
        marker.pose.orientation = make_quaternion(0.0)
        marker.scale.x = width_m
        marker.color.g = marker.color.a = 0.8
        return marker

    def _circle(self, goal: Pose2D, radius_m: float) -> Marker:
        marker = self._marker(Marker.LINE_STRIP, 0.02)
        angles = np.linspace(0.0, 2.0 * np.pi, 33)
        marker.points = [
            Point(x=float(goal.x + radius_m * np.cos(a)), y=float(goal.y + radius_m * np.sin(a)))
            for a in angles
        ]
        return marker

    def _trajectories(self, positions: FloatArray) -> MarkerArray:
        marker = self._marker(Marker.LINE_LIST, 0.005)
        ends = np.stack([positions[:, :-1], positions[:, 1:]], axis=2).reshape(-1, 2)
        marker.points = [Point(x=x, y=y) for x, y in ends.tolist()]
        return MarkerArray(markers=[marker])
