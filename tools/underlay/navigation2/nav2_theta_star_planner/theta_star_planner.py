# SPDX-License-Identifier: Apache-2.0
"""The planner `nav2_theta_star_planner::ThetaStarPlanner`."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

from nav2_costmap_2d.costmap_node import Costmap2DROS
from nav2_planner.global_planner import GlobalPlanner, poses_along
from nav2_planner.grid_planner import GridPlanner
from nav2_planner.route import SearchOptions, weight_table
from nav2_util.geometry import Pose2D
from nav2_util.lifecycle_node import LifecycleNode
from nav2_util.parameters import parameter
import numpy as np
import numpy.typing as npt

__all__ = ['ThetaStarPlanner']


@dataclass(frozen=True)
class ThetaStarParameters:
    """The parameters of Theta*."""

    how_many_corners: int = parameter(
        8, 'In how many directions the search goes on from a cell: 4 or 8.', choices=(4, 8)
    )
    w_euc_cost: float = parameter(1.0, 'The weight of the length of the path.', low=0.0)
    w_traversal_cost: float = parameter(
        2.0, 'The weight of the square of the share that a cell has of the highest cost.', low=0.0
    )
    w_heuristic_cost: float = parameter(
        1.0, 'The weight of the distance to the goal; an exact search needs none.', low=0.0
    )
    use_final_approach_orientation: bool = parameter(
        False, 'Whether the last pose faces along the path, and not as the goal.'
    )
    allow_unknown: bool = parameter(True, 'Whether to plan through unknown space.')
    terminal_checking_interval: int = parameter(
        5000, 'After how many cells a canceled goal is noticed; it is between two paths.', low=1
    )


class ThetaStarPlanner(GlobalPlanner):
    """
    Planner of any-angle paths of straight lines.

    Parameters
    ----------
    node, name, costmap
        As for `GlobalPlanner`: the planner server, the planner's name and the global costmap.

    Notes
    -----
    The lines come from a search on the grid that is pulled taut afterwards, where Theta* (Nash et
    al., 2007) does both at once: the path is as straight, and its cost is no higher than that of
    the cheapest path from cell to cell. The goal itself has to be reachable: there is no
    tolerance.

    """

    def __init__(self, node: LifecycleNode, name: str, costmap: Costmap2DROS) -> None:
        super().__init__(node, name, costmap)
        self._parameters = node.parameters.declare(ThetaStarParameters, prefix=name)
        self._planners = {4: GridPlanner(diagonal=False), 8: GridPlanner(diagonal=True)}

    def create_plan(
        self, start: Pose2D, goal: Pose2D
    ) -> Generator[None, None, npt.NDArray[np.float64]]:
        """
        Plan a path of straight lines, in steps like `GlobalPlanner.create_plan`.

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
        table = weight_table(
            values.w_traversal_cost,
            neutral=values.w_euc_cost,
            power=2.0,
            allow_unknown=values.allow_unknown,
        )
        grid = self.costmap.grid
        planner = self._planners[values.how_many_corners]
        route = yield from planner.plan(grid, start, goal, SearchOptions(table, 0.0))
        return poses_along(
            route,
            start,
            goal,
            resolution=grid.resolution,
            use_final_approach_orientation=values.use_final_approach_orientation,
        )
