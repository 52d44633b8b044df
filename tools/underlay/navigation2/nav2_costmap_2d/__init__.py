# SPDX-License-Identifier: Apache-2.0
"""Costmaps: layered grids of the cost of positions."""

from nav2_costmap_2d.costmap_node import Costmap2DROS, make_costmap
from nav2_costmap_2d.footprint import Footprint, FootprintCollisionChecker, is_collision
from nav2_costmap_2d.grid import Costmap2D

__all__ = [
    'Costmap2D',
    'Costmap2DROS',
    'Footprint',
    'FootprintCollisionChecker',
    'is_collision',
    'make_costmap',
]
