# SPDX-License-Identifier: Apache-2.0
"""Costmap and footprint from topics, for the collision checks of the smoother server."""

from __future__ import annotations

from geometry_msgs.msg import PolygonStamped
from nav2_costmap_2d.costmap_messages import corners_of, costmap_from
from nav2_costmap_2d.costs import LETHAL_OBSTACLE, NO_INFORMATION
from nav2_costmap_2d.footprint import FootprintCollisionChecker
from nav2_costmap_2d.grid import Costmap2D
from nav2_msgs.msg import Costmap, CostmapUpdate
from nav2_util.geometry import Pose2D
from nav2_util.lifecycle_node import LifecycleNode
from nav2_util.qos import LATCHED
from nav2_util.transforms import TransformError
import numpy as np
import numpy.typing as npt

__all__ = ['Surroundings']

FloatArray = npt.NDArray[np.float64]


class Surroundings:
    """
    Newest costmap and footprint, converted on demand.

    Parameters
    ----------
    node
        The smoother server.
    costmap_topic
        The topic of nav2_msgs/Costmap; its updates have the same name with _updates.
    footprint_topic
        The topic of the footprint, in the frame of the costmap or of the robot.
    base_frame
        The frame of the robot.

    """

    def __init__(
        self, node: LifecycleNode, costmap_topic: str, footprint_topic: str, base_frame: str
    ) -> None:
        self._node, self._base_frame = node, base_frame
        self.costmap_topic, self.footprint_topic = costmap_topic, footprint_topic
        self._message: Costmap | None = None
        self._updates: list[CostmapUpdate] = []
        self._grid: Costmap2D | None = None
        self._footprint: PolygonStamped | None = None
        self._corners: FloatArray | None = None
        node.create_subscription(Costmap, costmap_topic, self._take_costmap, LATCHED)
        node.create_subscription(CostmapUpdate, f'{costmap_topic}_updates', self._take_update, 10)
        node.create_subscription(PolygonStamped, footprint_topic, self._take_footprint, 1)

    @property
    def frame(self) -> str:
        """Return the frame of the costmap; empty before the first."""
        return '' if self._message is None else str(self._message.header.frame_id)

    def grid(self) -> Costmap2D | None:
        """Return the newest costmap; None before the first."""
        try:
            if self._grid is None and self._message is not None:
                self._grid = costmap_from(self._message).copy()
            if self._grid is not None:
                for update in self._updates:
                    _apply(update, self._grid)
        except ValueError as error:
            self._node.get_logger().warning(f"'{self.costmap_topic}' cannot be used: {error}")
            self._grid = None
        self._updates.clear()
        return self._grid

    def colliding(self, poses: FloatArray) -> npt.NDArray[np.intp] | None:
        """
        Find the poses at which the robot is in collision.

        Parameters
        ----------
        poses
            (N, 3) x and y in m, yaw in rad, in the frame of the costmap.

        Returns
        -------
        Their indices, or None if costmap or footprint are unavailable.

        """
        grid, corners = self.grid(), self._corners_of_robot()
        if grid is None or corners is None:
            return None
        costs = FootprintCollisionChecker(grid).footprint_costs(poses, corners)
        return np.flatnonzero((costs >= LETHAL_OBSTACLE) & (costs != NO_INFORMATION))

    def _corners_of_robot(self) -> FloatArray | None:
        """Transform the corners of the footprint to the robot's frame."""
        message = self._footprint
        if message is not None:
            points = corners_of(message.polygon)
            frame = message.header.frame_id
            try:
                if frame and frame != self._base_frame:
                    robot = self._node.transforms.pose_of(self._base_frame, frame)
                    points = _seen_from(robot, points)
            except TransformError as error:
                self._node.get_logger().warning(f'The footprint cannot be used. {error}')
                return self._corners
            self._corners, self._footprint = points, None
        return self._corners

    def _take_costmap(self, message: Costmap) -> None:
        self._message, self._grid = message, None
        self._updates.clear()

    def _take_update(self, message: CostmapUpdate) -> None:
        if self._message is None:
            return
        self._updates.append(message)
        if len(self._updates) > 20:
            self.grid()

    def _take_footprint(self, message: PolygonStamped) -> None:
        if message.polygon.points:
            self._footprint = message


def _apply(update: CostmapUpdate, grid: Costmap2D) -> None:
    cells = np.asarray(update.data, np.uint8).reshape(update.size_y, update.size_x)
    top, right = update.y + update.size_y, update.x + update.size_x
    grid.cells[slice(update.y, top), slice(update.x, right)] = cells


def _seen_from(robot: Pose2D, points: FloatArray) -> FloatArray:
    cos, sin = np.cos(robot.yaw), np.sin(robot.yaw)
    seen: FloatArray = (points - (robot.x, robot.y)) @ np.array([[cos, -sin], [sin, cos]])
    return seen
