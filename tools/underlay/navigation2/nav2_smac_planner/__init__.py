# SPDX-License-Identifier: Apache-2.0
"""The Smac planners: cost-aware search in the plane, with smoothed paths."""

from nav2_smac_planner.planar import SmacPlannerHybrid, SmacPlannerLattice
from nav2_smac_planner.smac_planner_2d import SmacPlanner2D

__all__ = ['SmacPlanner2D', 'SmacPlannerHybrid', 'SmacPlannerLattice']
