# SPDX-License-Identifier: Apache-2.0
"""NavFn: the planner of the cheapest path through the cells of a costmap."""

from nav2_navfn_planner.navfn_planner import NavfnPlanner

__all__ = ['NavfnPlanner']
