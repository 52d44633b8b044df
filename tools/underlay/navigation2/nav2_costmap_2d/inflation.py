# SPDX-License-Identifier: Apache-2.0
"""Inflation: costs that decay with the distance from obstacles."""

from __future__ import annotations

from dataclasses import dataclass
import functools
import math

import cv2
from nav2_costmap_2d.costs import (
    FREE_SPACE,
    INSCRIBED_INFLATED_OBSTACLE,
    LETHAL_OBSTACLE,
    NO_INFORMATION,
)
from nav2_costmap_2d.grid import CellArray, Costmap2D
from nav2_costmap_2d.regions import Region
import numpy as np

__all__ = ['Inflation', 'decayed_cost']


def decayed_cost(distance_m: float, inscribed_radius_m: float, scaling: float) -> int:
    """
    Compute the cost at a distance in m from the nearest obstacle.

    Parameters
    ----------
    distance_m
        The distance from the centre of the obstacle's cell.
    inscribed_radius_m
        The distance up to which the robot collides.
    scaling
        The decay rate beyond it in 1/m: the `cost_scaling_factor`.

    """
    if distance_m <= 0.0:
        return LETHAL_OBSTACLE
    if distance_m <= inscribed_radius_m:
        return INSCRIBED_INFLATED_OBSTACLE
    decay = math.exp(-scaling * (distance_m - inscribed_radius_m))
    return int((INSCRIBED_INFLATED_OBSTACLE - 1) * decay)


@functools.lru_cache(maxsize=16)
def _cost_table(
    reach: int, resolution: float, inscribed_radius_m: float, scaling: float
) -> CellArray:
    """Precompute the cost for each squared distance in cells."""
    distances = np.sqrt(np.arange(reach * reach + 2)) * resolution
    decays = np.exp(-scaling * np.maximum(distances - inscribed_radius_m, 0.0))
    table = ((INSCRIBED_INFLATED_OBSTACLE - 1) * decays).astype(np.uint8)
    table[distances <= inscribed_radius_m] = INSCRIBED_INFLATED_OBSTACLE
    table[0] = LETHAL_OBSTACLE
    table[-1] = FREE_SPACE
    return table


@dataclass(frozen=True)
class Inflation:
    """Inflation of the costs around obstacles."""

    inflation_radius_m: float
    inscribed_radius_m: float
    scaling: float
    """In 1/m."""
    inflates_unknown: bool = False
    """Whether unknown cells accept every cost above zero; otherwise only those of a collision."""
    inflates_around_unknown: bool = False
    """Whether unknown cells count as obstacles."""

    def reach(self, resolution: float) -> int:
        """
        Convert the inflation radius to cells, rounded up.

        Parameters
        ----------
        resolution
            The side of a cell in m.

        """
        return math.ceil(self.inflation_radius_m / resolution - 1e-9)

    def apply(self, grid: Costmap2D, region: Region) -> None:
        """
        Inflate a region of a costmap, in place.

        Parameters
        ----------
        grid
            The costmap; obstacles around the region are considered, too.
        region
            The cells to write.

        """
        reach = self.reach(grid.resolution)
        around = region.grown(reach).clipped(grid)
        if reach <= 0 or around is None:
            return
        window = grid.cells[around.slices]
        is_free = window != LETHAL_OBSTACLE
        if self.inflates_around_unknown:
            is_free &= window != NO_INFORMATION
        if is_free.all():
            return
        distances = cv2.distanceTransform(
            is_free.view(np.uint8), cv2.DIST_L2, cv2.DIST_MASK_PRECISE
        )
        inner = (
            slice(region.y - around.y, region.y_end - around.y),
            slice(region.x - around.x, region.x_end - around.x),
        )
        table = _cost_table(reach, grid.resolution, self.inscribed_radius_m, self.scaling)
        near = np.minimum(distances[inner], reach + 1.0)
        # Squared distances between cell centres are integers.
        squares = np.rint(near * near).astype(np.int32)
        costs = table.take(squares, mode='clip')
        self._write(grid.cells[region.slices], costs)

    def _write(self, cells: CellArray, costs: CellArray) -> None:
        unknown = cells == NO_INFORMATION
        if not unknown.any():
            np.maximum(cells, costs, out=cells)
            return
        least = FREE_SPACE + 1 if self.inflates_unknown else INSCRIBED_INFLATED_OBSTACLE
        known = np.where(unknown & (costs >= least), costs, np.maximum(cells, costs))
        if self.inflates_around_unknown:
            known[unknown & (costs == LETHAL_OBSTACLE)] = NO_INFORMATION
        cells[...] = known
