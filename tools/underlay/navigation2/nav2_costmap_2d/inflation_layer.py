# SPDX-License-Identifier: Apache-2.0
"""The inflation layer: costs that decay with the distance from obstacles."""

from __future__ import annotations

from dataclasses import dataclass
import functools
import math
from typing import TYPE_CHECKING

import cv2
from nav2_costmap_2d.costs import (
    FREE_SPACE,
    INSCRIBED_INFLATED_OBSTACLE,
    LETHAL_OBSTACLE,
    NO_INFORMATION,
)
from nav2_costmap_2d.footprint import Footprint
from nav2_costmap_2d.grid import CellArray, Costmap2D
from nav2_costmap_2d.layers import Layer
from nav2_costmap_2d.regions import Region
from nav2_util.parameters import parameter
import numpy as np

if TYPE_CHECKING:
    from nav2_costmap_2d.costmap_node import Costmap2DROS

__all__ = ['Inflation', 'InflationLayer', 'InflationParameters']


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


@dataclass(frozen=True)
class InflationParameters:
    """The parameters of `nav2_costmap_2d::InflationLayer`."""

    enabled: bool = parameter(True, 'Whether the layer takes part.')
    inflation_radius: float = parameter(
        0.55, 'Up to which distance from obstacles costs are raised, in m.', low=0.0
    )
    cost_scaling_factor: float = parameter(
        10.0, 'How fast costs decay with the distance, in 1/m.', low=0.0
    )
    inflate_unknown: bool = parameter(False, 'Whether costs are raised in unknown cells, too.')
    inflate_around_unknown: bool = parameter(
        False, 'Whether costs are raised around unknown cells as around obstacles.'
    )


class InflationLayer(Layer):
    """
    Layer that inflates obstacles, so that paths keep away from them.

    Parameters
    ----------
    node
        The costmap's node.
    name
        The name of the layer.

    """

    def __init__(self, node: Costmap2DROS, name: str) -> None:
        super().__init__(name)
        self._node = node
        self._settings = node.parameters.declare(InflationParameters, name)
        self._settings.on_change = lambda _: node.touch()
        self._inscribed_radius_m = node.shape.inscribed_radius_m

    @property
    def is_enabled(self) -> bool:
        """Whether the layer is enabled."""
        return self._settings.current.enabled

    @property
    def cost_scaling_factor(self) -> float:
        """The decay rate of the costs with the distance, in 1/m."""
        return self._settings.current.cost_scaling_factor

    @property
    def inflation_radius(self) -> float:
        """The distance from obstacles up to which costs are raised, in m."""
        return self._settings.current.inflation_radius

    def set_footprint(self, footprint: Footprint) -> None:
        """
        Set the inscribed radius, up to which the robot collides.

        Parameters
        ----------
        footprint
            The new shape of the robot.

        """
        self._inscribed_radius_m = footprint.inscribed_radius_m

    def affected(self, region: Region) -> Region:
        """
        Extend a changed region by the inflation radius.

        Parameters
        ----------
        region
            The cells that the layers below have changed.

        Returns
        -------
        Region
            The cells whose inflation depends on the region, possibly beyond the grid.

        """
        return region.grown(self._inflation().reach(self._node.grid.resolution))

    def apply(self, grid: Costmap2D, region: Region) -> None:
        """
        Raise the costs around obstacles, in place.

        Parameters
        ----------
        grid, region
            As for `Layer.apply`.

        """
        self._inflation().apply(grid, region)

    def _inflation(self) -> Inflation:
        values = self._settings.current
        return Inflation(
            values.inflation_radius,
            self._inscribed_radius_m,
            values.cost_scaling_factor,
            values.inflate_unknown,
            values.inflate_around_unknown,
        )
