# SPDX-License-Identifier: Apache-2.0
"""The planner interface: a plugin of the planner server that plans a path between two poses."""

from __future__ import annotations

from collections.abc import Generator
from typing import TypeVar

from nav2_costmap_2d.costmap_node import Costmap2DROS
from nav2_planner.path_shape import headings, resample, round_corners, Rounding
from nav2_planner.route import Route
from nav2_util.geometry import Pose2D
from nav2_util.lifecycle_node import LifecycleNode
import numpy as np
import numpy.typing as npt

__all__ = ['PLANNERS', 'GlobalPlanner', 'finish', 'poses_along']

FloatArray = npt.NDArray[np.float64]
ResultT = TypeVar('ResultT')

PLANNERS = {
    'nav2_navfn_planner::NavfnPlanner': 'nav2_navfn_planner.navfn_planner:NavfnPlanner',
    'nav2_smac_planner::SmacPlanner2D': 'nav2_smac_planner.smac_planner_2d:SmacPlanner2D',
    'nav2_smac_planner::SmacPlannerHybrid': (
        'nav2_smac_planner.smac_planner_hybrid:SmacPlannerHybrid'
    ),
    'nav2_smac_planner::SmacPlannerLattice': 'nav2_smac_planner.planar:SmacPlannerLattice',
    'nav2_theta_star_planner::ThetaStarPlanner': (
        'nav2_theta_star_planner.theta_star_planner:ThetaStarPlanner'
    ),
}
"""The import paths of planners by their official names."""


class GlobalPlanner:
    """
    Base class of planners.

    Parameters
    ----------
    node
        The planner server, with which the constructor declares parameters.
    name
        The planner's name, the prefix of its parameters, such as GridBased.
    costmap
        The global costmap.

    """

    def __init__(self, node: LifecycleNode, name: str, costmap: Costmap2DROS) -> None:
        self.node, self.name, self.costmap = node, name, costmap

    def create_plan(self, start: Pose2D, goal: Pose2D) -> Generator[None, None, FloatArray]:
        """
        Plan a path.

        It yields about every ten milliseconds, so that other callbacks can run, and may be
        abandoned there.

        Parameters
        ----------
        start, goal
            Poses in the frame of the costmap.

        Returns
        -------
        (N, 3) poses from the start to the goal, at most a cell apart: x and y in m, yaw in rad.

        Raises
        ------
        PlanningError
            There is no path.

        """
        raise NotImplementedError


def poses_along(
    route: Route,
    start: Pose2D,
    goal: Pose2D,
    *,
    resolution: float,
    rounding: Rounding | None = None,
    use_final_approach_orientation: bool = False,
) -> FloatArray:
    """
    Convert a route to the poses of a path.

    Parameters
    ----------
    route
        The straight lines that were planned.
    start, goal
        Poses in the frame of the costmap.
    resolution
        The largest distance of neighbours in m.
    rounding
        How to round corners; None keeps them.
    use_final_approach_orientation
        Whether the last pose faces along the path instead of having the goal's yaw.

    Returns
    -------
    (N, 3) poses: x and y in m, yaw in rad. All but the last face along the path. The last one is
    the goal itself if the route reaches it.

    """
    spacing = resolution / route.cell_m
    points = resample(route.corners, spacing)
    if rounding is not None and len(points) > 2:
        points = round_corners(
            points, route.weights, rounding.smooth, rounding.data, rounding.times
        )
        points = resample(points, spacing)
    places = route.to_world(points)
    if len(places) > 1:
        places[0] = start.x, start.y
    if route.is_exact:
        places[-1] = goal.x, goal.y
    yaws = headings(places, None if use_final_approach_orientation else goal.yaw)
    if len(places) == 1 and use_final_approach_orientation:
        yaws[:] = start.yaw
    return np.column_stack([places, yaws])


def finish(work: Generator[None, None, ResultT]) -> ResultT:
    """
    Run a generator to its end in one step.

    Parameters
    ----------
    work
        The generator, such as that of `GlobalPlanner.create_plan`.

    Returns
    -------
    ResultT
        The return value of the generator.

    """
    while True:
        try:
            next(work)
        except StopIteration as stop:
            result: ResultT = stop.value
            return result
