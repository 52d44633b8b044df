# SPDX-License-Identifier: Apache-2.0
"""SmacPlannerHybrid: paths that a car can drive, by Hybrid-A*."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

from nav2_costmap_2d.costmap_node import Costmap2DROS
from nav2_planner.global_planner import GlobalPlanner
from nav2_smac_planner.hybrid_search import HybridOptions, HybridSearch
from nav2_smac_planner.hybrid_smoothing import smoothed_path
from nav2_smac_planner.smac_planner_2d import Smoothing, UnsmoothedPlan
from nav2_util.geometry import Pose2D
from nav2_util.lifecycle_node import LifecycleNode
from nav2_util.parameters import parameter, Unsupported
import numpy as np
import numpy.typing as npt

__all__ = ['HybridParameters', 'SmacPlannerHybrid']

_DUBIN, _REEDS_SHEPP = 'DUBIN', 'REEDS_SHEPP'
_UNSUPPORTED = {
    'downsample_costmap': Unsupported('the search is in the cells of the costmap', (False,)),
    'downsampling_factor': Unsupported('the search is in the cells of the costmap'),
    'terminal_checking_interval': Unsupported('a canceled goal is noticed in 10 ms'),
    'lookup_table_size': Unsupported('there is no table of distances'),
    'cache_obstacle_heuristic': Unsupported(
        'the distances to the goal are computed for each path', (False,)
    ),
    'downsample_obstacle_heuristic': Unsupported(
        'distances to the goal are computed in larger cells if the costmap is large'
    ),
    'allow_primitive_interpolation': Unsupported(
        'the motions are straight on, and the narrowest curves', (False,)
    ),
    'debug_visualizations': Unsupported('the search is not published', (False,)),
    'viz_expansions': Unsupported('the search is not published', (False,)),
}


@dataclass(frozen=True)
class HybridParameters:
    """The parameters of Hybrid-A*."""

    tolerance: float = parameter(
        0.25, 'How far from a goal that cannot be reached the path may end, in m.', low=0.0
    )
    allow_unknown: bool = parameter(True, 'Whether to plan through unknown space.')
    max_iterations: int = parameter(
        1_000_000, 'Give up when more poses than that are expanded; -1 for no limit.'
    )
    max_on_approach_iterations: int = parameter(
        1000, 'How many poses are expanded after one within the tolerance.', low=1
    )
    max_planning_time: float = parameter(5.0, 'Give up after this time in s.', low=0.0)
    motion_model_for_search: str = parameter(
        _DUBIN,
        'Whether to drive only forward, or backward as well.',
        choices=(_DUBIN, _REEDS_SHEPP),
    )
    angle_quantization_bins: int = parameter(72, 'The number of headings.', low=4, high=720)
    minimum_turning_radius: float = parameter(0.4, 'The turning radius in m.', low=0.001)
    analytic_expansion_ratio: float = parameter(
        3.5, 'How often a curve to the goal is tried: more often the nearer it is.', low=0.1
    )
    analytic_expansion_max_length: float = parameter(
        3.0, 'The longest curve to the goal that is tried, in m.', low=0.0
    )
    analytic_expansion_max_cost: float = parameter(
        200.0, 'The highest cost on such a curve.', low=0.0
    )
    analytic_expansion_max_cost_override: bool = parameter(
        False, 'Whether that holds very near the goal, too.'
    )
    reverse_penalty: float = parameter(2.0, 'The factor of a metre backward.', low=1.0)
    change_penalty: float = parameter(
        0.0, 'What is added to that of curves when the steering changes sides.', low=0.0
    )
    non_straight_penalty: float = parameter(1.2, 'The factor of a metre in a curve.', low=1.0)
    retrospective_penalty: float = parameter(
        0.015, 'The share by which later steps are cheaper.', low=0.0, high=0.99
    )
    cost_penalty: float = parameter(
        2.0, 'How much more a metre costs at the highest cost than in free space.', low=0.0
    )
    use_quadratic_cost_penalty: bool = parameter(
        False, 'Whether that rises with the square of the cost.'
    )
    smooth_path: bool = parameter(
        True, 'Whether to smooth the path where the robot can still drive it.'
    )

    def options(self) -> HybridOptions:
        """Convert the parameters to options of the search."""
        return HybridOptions(
            radius_m=self.minimum_turning_radius,
            headings=self.angle_quantization_bins,
            can_reverse=self.motion_model_for_search == _REEDS_SHEPP,
            allow_unknown=self.allow_unknown,
            tolerance_m=self.tolerance,
            max_iterations=max(self.max_iterations, 0),
            max_approach_iterations=self.max_on_approach_iterations,
            max_time_s=self.max_planning_time,
            cost_penalty=self.cost_penalty,
            cost_power=2.0 if self.use_quadratic_cost_penalty else 1.0,
            reverse_penalty=self.reverse_penalty,
            change_penalty=self.change_penalty,
            non_straight_penalty=self.non_straight_penalty,
            retrospective_penalty=self.retrospective_penalty,
            expansion_ratio=self.analytic_expansion_ratio,
            expansion_max_length_m=self.analytic_expansion_max_length,
            expansion_max_cost=self.analytic_expansion_max_cost,
            expand_at_any_cost=not self.analytic_expansion_max_cost_override,
        )


class SmacPlannerHybrid(GlobalPlanner):
    """
    Planner of paths for a robot with a turning radius, which may drive backward.

    Parameters
    ----------
    node, name, costmap
        As for `GlobalPlanner`: the planner server, the planner's name and the global costmap.

    """

    def __init__(self, node: LifecycleNode, name: str, costmap: Costmap2DROS) -> None:
        super().__init__(node, name, costmap)
        self._parameters = node.parameters.declare(HybridParameters, prefix=name)
        node.parameters.declare_unsupported(_UNSUPPORTED, prefix=name)
        self._smoothing = Smoothing(node, name)
        self._unsmoothed = UnsmoothedPlan(node)

    def create_plan(
        self, start: Pose2D, goal: Pose2D
    ) -> Generator[None, None, npt.NDArray[np.float64]]:
        """
        Plan a path, in steps like `GlobalPlanner.create_plan`.

        Parameters
        ----------
        start, goal
            Poses in the frame of the costmap.

        Returns
        -------
        numpy.ndarray
            (N, 3) poses: x and y in m, yaw in rad; where the robot drives backward, the yaw is
            opposite to the direction of the path.

        Raises
        ------
        PlanningError
            There is no path.

        """
        values = self._parameters.current
        options, rounding = values.options(), self._smoothing.rounding
        footprint = self.costmap.collision_footprint
        search = HybridSearch(self.costmap.grid, footprint, options, start, goal)
        poses = yield from search.plan()
        self._unsmoothed.publish(poses, self.costmap.global_frame)
        if values.smooth_path and rounding is not None:
            poses = smoothed_path(poses, rounding, options.radius_m, search.is_free)
        return poses
