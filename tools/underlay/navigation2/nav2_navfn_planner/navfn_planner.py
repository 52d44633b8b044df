# SPDX-License-Identifier: Apache-2.0
"""The planner `nav2_navfn_planner::NavfnPlanner`."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

from nav2_costmap_2d.costmap_node import Costmap2DROS
from nav2_planner.global_planner import GlobalPlanner, poses_along
from nav2_planner.grid_planner import GridPlanner
from nav2_planner.path_shape import Rounding
from nav2_planner.route import SearchOptions, weight_table
from nav2_util.geometry import Pose2D
from nav2_util.lifecycle_node import LifecycleNode
from nav2_util.parameters import parameter
import numpy as np
import numpy.typing as npt

__all__ = ['NavfnPlanner']

# A metre at the highest cost counts as five in free space: (50 + 0.8 x 252) / 50.
_TRAVERSAL = 0.8 * 252.0 / 50.0
_ROUNDING = Rounding(smooth=9.0, data=1.0, times=2)


@dataclass(frozen=True)
class NavfnParameters:
    """The parameters of NavFn."""

    tolerance: float = parameter(
        0.5, 'How far from a goal that cannot be reached the path may end, in m.', low=0.0
    )
    use_astar: bool = parameter(
        False, 'Whether to search by A*; the path is the same, as the search is exact.'
    )
    allow_unknown: bool = parameter(True, 'Whether to plan through unknown space.')
    use_final_approach_orientation: bool = parameter(
        False, 'Whether the last pose faces along the path, and not as the goal.'
    )


class NavfnPlanner(GlobalPlanner):
    """
    Planner of the cheapest path through the costmap, with rounded corners.

    Parameters
    ----------
    node, name, costmap
        As for `GlobalPlanner`: the planner server, the planner's name and the global costmap.

    """

    def __init__(self, node: LifecycleNode, name: str, costmap: Costmap2DROS) -> None:
        super().__init__(node, name, costmap)
        self._parameters = node.parameters.declare(NavfnParameters, prefix=name)
        self._planner = GridPlanner()

    def create_plan(
        self, start: Pose2D, goal: Pose2D
    ) -> Generator[None, None, npt.NDArray[np.float64]]:
        """
        Plan the cheapest path, in steps like `GlobalPlanner.create_plan`.

        Parameters
        ----------
        start, goal
            Poses in the frame of the costmap.

        Returns
        -------
        numpy.ndarray
            (N, 3) poses: x and y in m, yaw in rad.

        Raises
        ------
        PlanningError
            There is no path.

        """
        values = self._parameters.current
        table = weight_table(_TRAVERSAL, allow_unknown=values.allow_unknown)
        grid = self.costmap.grid
        route = yield from self._planner.plan(
            grid, start, goal, SearchOptions(table, values.tolerance)
        )
        return poses_along(
            route,
            start,
            goal,
            resolution=grid.resolution,
            rounding=_ROUNDING,
            use_final_approach_orientation=values.use_final_approach_orientation,
        )
