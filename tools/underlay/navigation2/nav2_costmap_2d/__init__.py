# SPDX-License-Identifier: Apache-2.0
"""Costmaps: grids that say how much it costs to be where, made of layers."""

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
