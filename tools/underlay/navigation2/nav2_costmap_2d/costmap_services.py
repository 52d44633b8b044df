# SPDX-License-Identifier: Apache-2.0
"""The services of a costmap: clear obstacles, and get costs."""

from __future__ import annotations

from typing import Any, TYPE_CHECKING

from nav2_costmap_2d.costmap_messages import make_costmap_message
from nav2_costmap_2d.footprint import FootprintCollisionChecker
from nav2_costmap_2d.grid import Costmap2D
from nav2_costmap_2d.regions import Region
from nav2_msgs.srv import (
    ClearCostmapAroundPose,
    ClearCostmapAroundRobot,
    ClearCostmapExceptRegion,
    ClearEntireCostmap,
    GetCost,
    GetCostmap,
)
from nav2_util.geometry import Pose2D
from nav2_util.transforms import TransformError

if TYPE_CHECKING:
    from nav2_costmap_2d.costmap_node import Costmap2DROS

__all__ = ['CostmapServices', 'square_around']

_OUTSIDE = -1.0


def square_around(grid: Costmap2D, pose: Pose2D, side_m: float) -> Region:
    """
    Compute the cells of a square around a pose.

    Parameters
    ----------
    grid
        The costmap.
    pose
        The centre of the square; its sides are parallel to the axes whatever the yaw.
    side_m
        The length of a side in m.

    Returns
    -------
    Region
        The cells that the square touches, also beyond the grid.

    """
    half = 0.5 * side_m
    corners = [(pose.x - half, pose.y - half), (pose.x + half, pose.y + half)]
    (x, y), (x_end, y_end) = grid.world_to_map_array(corners).tolist()
    return Region(x, y, x_end + 1, y_end + 1)


class CostmapServices:
    """
    Services of a costmap.

    Parameters
    ----------
    node
        The costmap's node. Its name is part of theirs.

    """

    def __init__(self, node: Costmap2DROS) -> None:
        self._node = node
        name = node.get_name()
        offer = node.create_service
        offer(ClearEntireCostmap, f'clear_entirely_{name}', self._clear_entirely)
        offer(ClearCostmapExceptRegion, f'clear_except_{name}', self._clear_except)
        offer(ClearCostmapAroundRobot, f'clear_around_{name}', self._clear_around)
        offer(ClearCostmapAroundPose, f'clear_around_pose_{name}', self._clear_around_pose)
        offer(GetCost, f'get_cost_{name}', self._get_cost)
        offer(GetCostmap, 'get_costmap', self._get_costmap)

    def _clear_entirely(self, _: Any, response: Any) -> Any:
        self._node.get_logger().info('Clearing the whole costmap')
        self._node.clear(None)
        return response

    def _clear_except(self, request: Any, response: Any) -> Any:
        self._clear_at_robot(request.reset_distance, is_inverted=True)
        return response

    def _clear_around(self, request: Any, response: Any) -> Any:
        self._clear_at_robot(request.reset_distance, is_inverted=False)
        return response

    def _clear_around_pose(self, request: Any, response: Any) -> Any:
        try:
            pose = self._node.transforms.pose_in(request.pose, self._node.global_frame)
        except TransformError as error:
            self._node.get_logger().error(f'Nothing was cleared: {error}')
            return response
        self._clear_square(pose, request.reset_distance, is_inverted=False)
        return response

    def _clear_at_robot(self, side_m: float, *, is_inverted: bool) -> None:
        try:
            pose = self._node.robot_pose()
        except TransformError as error:
            self._node.get_logger().error(f'Nothing was cleared: {error}')
            return
        self._clear_square(pose, side_m, is_inverted=is_inverted)

    def _clear_square(self, pose: Pose2D, side_m: float, *, is_inverted: bool) -> None:
        what = 'all but' if is_inverted else 'only'
        self._node.get_logger().info(
            f'Clearing {what} {side_m:g} x {side_m:g} m around {pose.x:.2f}, {pose.y:.2f}'
        )
        self._node.clear(lambda grid: square_around(grid, pose, side_m), is_inverted=is_inverted)

    def _get_cost(self, request: GetCost.Request, response: GetCost.Response) -> GetCost.Response:
        node = self._node
        if node.grid.world_to_map(request.x, request.y) is None:
            node.get_logger().warning(
                f'{request.x:.2f}, {request.y:.2f} is outside of the costmap'
            )
            response.cost = _OUTSIDE
        elif request.use_footprint:
            pose = (request.x, request.y, request.theta)
            checker = FootprintCollisionChecker(node.grid)
            response.cost = float(checker.footprint_cost(pose, node.footprint))
        else:
            response.cost = float(node.grid.cost_at(request.x, request.y))
        return response

    def _get_costmap(
        self, _: GetCostmap.Request, response: GetCostmap.Response
    ) -> GetCostmap.Response:
        stamp = self._node.get_clock().now().to_msg()
        response.map = make_costmap_message(self._node.grid, self._node.global_frame, stamp)
        return response
