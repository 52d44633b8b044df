# SPDX-License-Identifier: Apache-2.0
"""Collision checks against a costmap and a footprint from topics."""

from __future__ import annotations

from typing import Any

from geometry_msgs.msg import PolygonStamped
from nav2_costmap_2d.costs import LETHAL_OBSTACLE
from nav2_costmap_2d.footprint import FootprintCollisionChecker
from nav2_costmap_2d.grid import Costmap2D
from nav2_msgs.msg import Costmap, CostmapUpdate
from nav2_util import LifecycleNode, NavigationError, TransformError
from nav2_util.qos import LATCHED
import numpy as np
import numpy.typing as npt
from rclpy.time import Time

__all__ = ['CannotCheck', 'CollisionChecker']

FloatArray = npt.NDArray[np.float64]


class CannotCheck(NavigationError):
    """A collision check is impossible: no costmap, no footprint, or no transform of the robot."""


class CollisionChecker:
    """
    Collision checker for poses of the robot in a costmap. Unknown space is free.

    Parameters
    ----------
    node
        The node that subscribes.
    costmap_topic
        The topic of `nav2_msgs/Costmap`; its updates have the same name with `_updates`.
    footprint_topic
        The topic of the footprint, in any frame.
    base_frame
        The frame of the robot.

    """

    def __init__(
        self, node: LifecycleNode, costmap_topic: str, footprint_topic: str, base_frame: str
    ) -> None:
        self._node, self._base_frame = node, base_frame
        self._topics = costmap_topic, footprint_topic
        self._costmap: Costmap | None = None
        self._checker: FootprintCollisionChecker | None = None
        self._footprint_message: PolygonStamped | None = None
        self._footprint: FloatArray | None = None
        node.create_subscription(Costmap, costmap_topic, self._on_costmap, LATCHED)
        node.create_subscription(CostmapUpdate, f'{costmap_topic}_updates', self._on_update, 10)
        node.create_subscription(PolygonStamped, footprint_topic, self._on_footprint, 1)

    def first_collision(self, poses: FloatArray) -> int | None:
        """
        Find the first pose at which the robot collides or leaves the costmap.

        Parameters
        ----------
        poses
            (K, 3) x, y (m), yaw (rad) in the current base frame.

        Raises
        ------
        CannotCheck
            The check is impossible; the message states why.

        """
        checker, footprint = self._grid_checker(), self._footprint_now()
        assert self._costmap is not None
        frame = self._costmap.header.frame_id
        try:
            x, y, yaw = self._node.transforms.pose_of(self._base_frame, frame)
        except TransformError as error:
            raise CannotCheck(str(error)) from error
        cos, sin = np.cos(yaw), np.sin(yaw)
        there = poses @ np.array([[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]]) + (
            x,
            y,
            yaw,
        )
        costs = checker.footprint_costs(there, footprint)
        hits = np.flatnonzero(costs == LETHAL_OBSTACLE)
        return int(hits[0]) if hits.size else None

    def _on_costmap(self, message: Costmap) -> None:
        self._costmap, self._checker = message, None

    def _on_update(self, message: CostmapUpdate) -> None:
        """Update a rectangle of the newest costmap."""
        if self._costmap is None:
            return
        try:
            cells = self._grid_checker().costmap.cells
            part = np.asarray(message.data, dtype=np.uint8).reshape(message.size_y, message.size_x)
            top, right = message.y + message.size_y, message.x + message.size_x
            cells[slice(message.y, top), slice(message.x, right)] = part
        except (ValueError, CannotCheck) as error:
            self._node.get_logger().warning(
                f"Ignored an update of '{self._topics[0]}' that does not fit: {error}",
                throttle_duration_sec=5.0,
            )

    def _on_footprint(self, message: PolygonStamped) -> None:
        self._footprint_message = message

    def _grid_checker(self) -> FootprintCollisionChecker:
        if self._checker is None:
            if self._costmap is None:
                raise CannotCheck(
                    f"No costmap was received on '{self._topics[0]}' so far. Is its server active?"
                )
            self._checker = FootprintCollisionChecker(_grid_of(self._costmap))
        return self._checker

    def _footprint_now(self) -> FloatArray:
        """Compute the (N, 2) footprint corners in m in the base frame."""
        message = self._footprint_message
        if message is not None:
            self._footprint_message = None
            found = self._in_base_frame(message)
            # A stationary robot has the same footprint, whose outline is cached.
            if self._footprint is None or not _are_alike(found, self._footprint):
                self._footprint = found
        if self._footprint is None:
            raise CannotCheck(
                f"No footprint was received on '{self._topics[1]}' so far. Is the costmap active?"
            )
        return self._footprint

    def _in_base_frame(self, message: PolygonStamped) -> FloatArray | None:
        points = np.array([(p.x, p.y) for p in message.polygon.points], float).reshape(-1, 2)
        if len(points) < 3 or not np.all(np.isfinite(points)):
            return self._footprint
        frame = message.header.frame_id
        if frame == self._base_frame:
            return points
        stamp = Time.from_msg(message.header.stamp, clock_type=self._node.get_clock().clock_type)
        transforms = self._node.transforms
        try:
            x, y, yaw = transforms.pose_of(frame, self._base_frame, stamp)
        except TransformError:
            try:
                x, y, yaw = transforms.pose_of(frame, self._base_frame)
            except TransformError as error:
                raise CannotCheck(str(error)) from error
        cos, sin = np.cos(yaw), np.sin(yaw)
        return np.asarray(points @ np.array([[cos, sin], [-sin, cos]]) + (x, y))


def _are_alike(a: FloatArray | None, b: FloatArray) -> bool:
    return a is not None and a.shape == b.shape and bool(np.all(np.abs(a - b) < 1e-3))


def _grid_of(message: Costmap) -> Costmap2D:
    meta: Any = message.metadata
    cells = np.array(message.data, dtype=np.uint8)
    if not meta.size_x or cells.size != meta.size_x * meta.size_y or not meta.resolution > 0.0:
        raise CannotCheck(
            f'The costmap is malformed: {cells.size} cells are not {meta.size_x} x {meta.size_y}, '
            f'or the resolution {meta.resolution} m is invalid.'
        )
    return Costmap2D(
        meta.size_x,
        meta.size_y,
        meta.resolution,
        meta.origin.position.x,
        meta.origin.position.y,
        cells=cells.reshape(meta.size_y, meta.size_x),
    )
