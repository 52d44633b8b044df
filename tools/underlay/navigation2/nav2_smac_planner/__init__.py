# SPDX-License-Identifier: Apache-2.0
"""The Smac planners: cost-aware search, in the plane or for a robot with a turning radius."""

from nav2_smac_planner.planar import SmacPlannerLattice
from nav2_smac_planner.smac_planner_2d import SmacPlanner2D
from nav2_smac_planner.smac_planner_hybrid import SmacPlannerHybrid

__all__ = ['SmacPlanner2D', 'SmacPlannerHybrid', 'SmacPlannerLattice']
