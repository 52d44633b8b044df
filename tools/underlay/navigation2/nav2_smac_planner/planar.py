# SPDX-License-Identifier: Apache-2.0
"""Plan for an omnidirectional robot in place of a kinematically constrained planner."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

from nav2_costmap_2d.costmap_node import Costmap2DROS
from nav2_planner.global_planner import GlobalPlanner, poses_along
from nav2_planner.grid_planner import GridPlanner
from nav2_planner.path_shape import blend_headings
from nav2_planner.route import SearchOptions, weight_table
from nav2_smac_planner.smac_planner_2d import Smoothing, UnsmoothedPlan
from nav2_util.geometry import Pose2D
from nav2_util.lifecycle_node import LifecycleNode
import numpy as np
import numpy.typing as npt

__all__ = ['PlanarPlanner', 'PlanarSettings']


@dataclass(frozen=True)
class PlanarSettings:
    """
    Settings of a planar search, from the parameters of a kinematically constrained planner.

    Attributes
    ----------
    tolerance_m, max_cells, max_time_s, factor
        As in `SearchOptions`.
    allow_unknown, traversal, power
        As for `weight_table`.
    turning_radius_m
        The distance in m over which the robot turns by a radian.
    smooth_path
        Whether to smooth the path.

    """

    tolerance_m: float
    allow_unknown: bool
    max_cells: int
    max_time_s: float
    factor: int
    traversal: float
    power: float
    turning_radius_m: float
    smooth_path: bool


class PlanarPlanner(GlobalPlanner):
    """
    Planner of planar paths whose ends have the yaws of start and goal.

    The search ignores the turning radius and does not reverse: an Ackermann robot cannot follow
    every such path.

    Parameters
    ----------
    node, name, costmap
        As for `GlobalPlanner`: the planner server, the planner's name and the global costmap.

    """

    official_name = ''
    unsupported: dict[str, str] = {}

    def __init__(self, node: LifecycleNode, name: str, costmap: Costmap2DROS) -> None:
        super().__init__(node, name, costmap)
        self._smoothing = Smoothing(node, name)
        self._unsmoothed = UnsmoothedPlan(node)
        self._planner = GridPlanner()
        node.parameters.declare_unsupported(self.unsupported, prefix=name)
        node.get_logger().warning(
            f"'{name}' is a {self.official_name}: for this robot, which goes in any direction, it "
            'searches in the plane, as SmacPlanner2D does, and turns the poses from the yaw of '
            'the start to the path and to the yaw of the goal. Turning circles and reversing are '
            'not considered.'
        )

    @property
    def settings(self) -> PlanarSettings:
        """Return the settings from the current parameters."""
        raise NotImplementedError

    def create_plan(
        self, start: Pose2D, goal: Pose2D
    ) -> Generator[None, None, npt.NDArray[np.float64]]:
        """
        Plan a path in the plane, in steps like `GlobalPlanner.create_plan`.

        Parameters
        ----------
        start, goal
            Poses in the frame of the costmap.

        Returns
        -------
        numpy.ndarray
            (N, 3) poses: x and y in m, yaw in rad, which blends from that of the start to the
            direction of the path and to that of the goal.

        Raises
        ------
        PlanningError
            There is no path.

        """
        values = self.settings
        grid = self.costmap.grid
        options = SearchOptions(
            weight_table(values.traversal, power=values.power, allow_unknown=values.allow_unknown),
            values.tolerance_m,
            factor=values.factor,
            max_cells=values.max_cells,
            max_time_s=values.max_time_s,
        )
        route = yield from self._planner.plan(grid, start, goal, options)
        self._unsmoothed.publish(route, self.costmap.global_frame)
        poses = poses_along(
            route,
            start,
            goal,
            resolution=grid.resolution,
            rounding=self._smoothing.rounding if values.smooth_path else None,
            use_final_approach_orientation=True,
        )
        poses[:, 2] = blend_headings(
            poses[:, :2], poses[:, 2], start.yaw, goal.yaw, values.turning_radius_m
        )
        return poses
