# SPDX-License-Identifier: Apache-2.0
"""The planner `nav2_smac_planner::SmacPlanner2D`, with the smoothing of all Smac planners."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

from nav2_costmap_2d.costmap_node import Costmap2DROS
from nav2_planner.global_planner import GlobalPlanner, poses_along
from nav2_planner.grid_planner import GridPlanner
from nav2_planner.path_shape import headings, Rounding
from nav2_planner.route import Route, SearchOptions, weight_table
from nav2_util.geometry import make_path, Pose2D
from nav2_util.lifecycle_node import LifecycleNode
from nav2_util.parameters import parameter
from nav_msgs.msg import Path
import numpy as np
import numpy.typing as npt

__all__ = [
    'SmacPlanner2D',
    'SmootherParameters',
    'Smoothing',
    'UnsmoothedPlan',
    'corner_poses',
]

_MODELS = ('MOORE', 'VON_NEUMANN', '2D')


@dataclass(frozen=True)
class SmootherParameters:
    """The parameters of the smoother in the Smac planners."""

    max_iterations: int = parameter(
        1000, 'The smooth path is computed at once; 0 leaves the path as it was.', low=0
    )
    w_smooth: float = parameter(0.3, 'The weight of straightness.', low=0.0)
    w_data: float = parameter(0.2, 'The weight of nearness to the path planned.', low=0.0)
    tolerance: float = parameter(
        1e-10, 'The smooth path is exact to the precision of numbers.', low=0.0
    )
    do_refinement: bool = parameter(True, 'Whether to smooth the smooth path again.')
    refinement_num: int = parameter(2, 'How often to smooth it again.', low=0)


class Smoothing:
    """
    Path smoothing as configured by the parameters.

    Parameters
    ----------
    node
        The planner server.
    name
        The name of the planner.

    """

    def __init__(self, node: LifecycleNode, name: str) -> None:
        self._parameters = node.parameters.declare(SmootherParameters, prefix=f'{name}.smoother')

    @property
    def rounding(self) -> Rounding | None:
        """The current parameters of corner rounding."""
        values = self._parameters.current
        if not values.max_iterations:
            return None
        again = values.refinement_num if values.do_refinement else 0
        return Rounding(values.w_smooth, values.w_data, 1 + again)


def corner_poses(route: Route) -> npt.NDArray[np.float64]:
    """
    Compute the (N, 3) poses at the corners of a path, which face along it.

    Parameters
    ----------
    route
        The straight lines that were planned.

    """
    places = route.to_world(route.corners)
    return np.column_stack([places, headings(places)])


class UnsmoothedPlan:
    """
    Publisher of the unsmoothed path on `unsmoothed_plan`, if it has subscribers.

    Parameters
    ----------
    node
        The planner server.

    """

    def __init__(self, node: LifecycleNode) -> None:
        self._node = node
        self._publisher = node.create_lifecycle_publisher(Path, 'unsmoothed_plan', 1)

    def publish(self, poses: npt.NDArray[np.float64], frame: str) -> None:
        """
        Publish a path as it was planned.

        Parameters
        ----------
        poses
            (N, 3) x and y in m, yaw in rad.
        frame
            The frame of the costmap.

        """
        if not self._publisher.get_subscription_count():
            return
        self._publisher.publish(make_path(poses, frame, self._node.get_clock().now().to_msg()))


@dataclass(frozen=True)
class Smac2DParameters:
    """The parameters of the planar search."""

    tolerance: float = parameter(
        0.125, 'How far from a goal that cannot be reached the path may end, in m.', low=0.0
    )
    downsample_costmap: bool = parameter(
        False, 'Whether to search in larger cells, each at the highest cost in it.'
    )
    downsampling_factor: int = parameter(
        1, 'How many cells become one along each axis.', low=1, high=100
    )
    allow_unknown: bool = parameter(True, 'Whether to plan through unknown space.')
    max_iterations: int = parameter(
        1_000_000, 'Give up when more cells than that are expanded; -1 for no limit.'
    )
    max_on_approach_iterations: int = parameter(
        1000, 'The nearest cell within the tolerance is found without iterations.'
    )
    motion_model_for_search: str = parameter(
        'MOORE',
        'Whether to search in 8 directions or in 4, and pull the path taut afterwards.',
        choices=_MODELS,
    )
    terminal_checking_interval: int = parameter(
        5000, 'After how many cells a canceled goal is noticed; it is between two paths.', low=1
    )
    max_planning_time: float = parameter(2.0, 'Give up after this time in s.', low=0.0)
    cost_travel_multiplier: float = parameter(
        2.0, 'How much more a metre costs at the highest cost than in free space.', low=0.0
    )
    use_final_approach_orientation: bool = parameter(
        False, 'Whether the last pose faces along the path, and not as the goal.'
    )


class SmacPlanner2D(GlobalPlanner):
    """
    Planner of smoothed paths for an omnidirectional robot.

    Parameters
    ----------
    node, name, costmap
        As for `GlobalPlanner`: the planner server, the planner's name and the global costmap.

    """

    def __init__(self, node: LifecycleNode, name: str, costmap: Costmap2DROS) -> None:
        super().__init__(node, name, costmap)
        self._parameters = node.parameters.declare(Smac2DParameters, prefix=name)
        self._smoothing = Smoothing(node, name)
        self._unsmoothed = UnsmoothedPlan(node)
        self._planners = {each: GridPlanner(each != 'VON_NEUMANN') for each in _MODELS}

    def create_plan(
        self, start: Pose2D, goal: Pose2D
    ) -> Generator[None, None, npt.NDArray[np.float64]]:
        """
        Plan a smoothed path, in steps like `GlobalPlanner.create_plan`.

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
        grid = self.costmap.grid
        options = SearchOptions(
            weight_table(values.cost_travel_multiplier, allow_unknown=values.allow_unknown),
            values.tolerance,
            factor=values.downsampling_factor if values.downsample_costmap else 1,
            max_cells=max(values.max_iterations, 0),
            max_time_s=values.max_planning_time,
        )
        planner = self._planners[values.motion_model_for_search]
        route = yield from planner.plan(grid, start, goal, options)
        self._unsmoothed.publish(corner_poses(route), self.costmap.global_frame)
        return poses_along(
            route,
            start,
            goal,
            resolution=grid.resolution,
            rounding=self._smoothing.rounding,
            use_final_approach_orientation=values.use_final_approach_orientation,
        )
