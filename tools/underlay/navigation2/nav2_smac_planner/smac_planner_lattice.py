# SPDX-License-Identifier: Apache-2.0
"""The planner `nav2_smac_planner::SmacPlannerLattice`, for an omnidirectional robot only."""

from __future__ import annotations

from dataclasses import dataclass

from nav2_costmap_2d.costmap_node import Costmap2DROS
from nav2_smac_planner.planar import PlanarPlanner, PlanarSettings
from nav2_util.lifecycle_node import LifecycleNode
from nav2_util.parameters import parameter

__all__ = ['SmacPlannerLattice']

_SEARCH = 'the search is in the plane and not in poses, as this robot goes in any direction'
_TURNING_RADIUS_M = 0.4


@dataclass(frozen=True)
class LatticeParameters:
    """The parameters of the state lattice that apply to an omnidirectional robot."""

    allow_unknown: bool = parameter(True, 'Whether to plan through unknown space.')
    tolerance: float = parameter(
        0.25, 'How far from a goal that cannot be reached the path may end, in m.', low=0.0
    )
    max_iterations: int = parameter(
        1_000_000, 'Give up when more cells than that are expanded; -1 for no limit.'
    )
    max_planning_time: float = parameter(5.0, 'Give up after this time in s.', low=0.0)
    cost_penalty: float = parameter(
        2.0, 'How much more a metre costs at the highest cost than in free space.', low=0.0
    )
    use_quadratic_cost_penalty: bool = parameter(
        False, 'Whether that rises with the square of the cost.'
    )
    smooth_path: bool = parameter(True, 'Whether to smooth the path.')


class SmacPlannerLattice(PlanarPlanner):
    """
    Planner of smoothed paths that blend from the start's yaw to the path's and the goal's.

    Parameters
    ----------
    node, name, costmap
        As for `GlobalPlanner`: the planner server, the planner's name and the global costmap.

    """

    official_name = 'nav2_smac_planner::SmacPlannerLattice'
    unsupported = dict.fromkeys(
        [
            'lattice_filepath',
            'max_on_approach_iterations',
            'terminal_checking_interval',
            'analytic_expansion_ratio',
            'analytic_expansion_max_length',
            'analytic_expansion_max_cost',
            'analytic_expansion_max_cost_override',
            'reverse_penalty',
            'change_penalty',
            'non_straight_penalty',
            'rotation_penalty',
            'retrospective_penalty',
            'lookup_table_size',
            'cache_obstacle_heuristic',
            'allow_reverse_expansion',
            'debug_visualizations',
        ],
        _SEARCH,
    )

    def __init__(self, node: LifecycleNode, name: str, costmap: Costmap2DROS) -> None:
        super().__init__(node, name, costmap)
        self._parameters = node.parameters.declare(LatticeParameters, prefix=name)

    @property
    def settings(self) -> PlanarSettings:
        """Return the settings from the current parameters."""
        values = self._parameters.current
        return PlanarSettings(
            tolerance_m=values.tolerance,
            allow_unknown=values.allow_unknown,
            max_cells=max(values.max_iterations, 0),
            max_time_s=values.max_planning_time,
            factor=1,
            traversal=values.cost_penalty,
            power=2.0 if values.use_quadratic_cost_penalty else 1.0,
            turning_radius_m=_TURNING_RADIUS_M,
            smooth_path=values.smooth_path,
        )
