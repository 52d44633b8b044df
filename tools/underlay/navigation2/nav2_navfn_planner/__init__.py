# SPDX-License-Identifier: Apache-2.0
"""NavFn: the planner that follows the cheapest way through the cells of a costmap."""

from nav2_navfn_planner.navfn_planner import NavfnPlanner

__all__ = ['NavfnPlanner']
