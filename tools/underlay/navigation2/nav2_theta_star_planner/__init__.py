# SPDX-License-Identifier: Apache-2.0
"""Theta*: the planner of any-angle straight lines."""

from nav2_theta_star_planner.theta_star_planner import ThetaStarPlanner

__all__ = ['ThetaStarPlanner']
