# SPDX-License-Identifier: Apache-2.0
"""The layer that removes obstacles too small to be real."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import cv2
from nav2_costmap_2d.costs import FREE_SPACE, LETHAL_OBSTACLE
from nav2_costmap_2d.grid import CellArray, Costmap2D
from nav2_costmap_2d.layers import Layer
from nav2_costmap_2d.regions import Region
from nav2_util.parameters import parameter
import numpy as np

if TYPE_CHECKING:
    from nav2_costmap_2d.costmap_node import Costmap2DROS

__all__ = ['DenoiseLayer', 'DenoiseParameters', 'remove_small_groups']


@dataclass(frozen=True)
class DenoiseParameters:
    """The parameters of `nav2_costmap_2d::DenoiseLayer`."""

    enabled: bool = parameter(True, 'Whether the layer takes part.')
    minimal_group_size: int = parameter(
        2, 'Obstacles of fewer cells are removed; none at 0 or 1.', low=0
    )
    group_connectivity_type: int = parameter(
        8, 'Whether cells that touch at a corner are together: 4 or 8.', choices=(4, 8)
    )


def remove_small_groups(cells: CellArray, size: int, connectivity: int) -> None:
    """
    Remove groups of obstacles that are too small, in place.

    Parameters
    ----------
    cells
        Costs.
    size
        Groups of fewer cells are removed.
    connectivity
        4 or 8: how many neighbours a cell has.

    """
    is_obstacle = (cells == LETHAL_OBSTACLE).view(np.uint8)
    _, labels, statistics, _ = cv2.connectedComponentsWithStats(
        is_obstacle, connectivity=connectivity
    )
    is_small = statistics[:, cv2.CC_STAT_AREA] < size
    is_small[0] = False
    cells[is_small[labels]] = FREE_SPACE


class DenoiseLayer(Layer):
    """
    Layer that removes small groups of obstacles from the layers below.

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
        self._settings = node.parameters.declare(DenoiseParameters, name)
        self._settings.on_change = lambda _: node.touch()

    @property
    def is_enabled(self) -> bool:
        """Whether the layer is enabled."""
        return self._settings.current.enabled

    def affected(self, region: Region) -> Region:
        """
        Extend a changed region to all cells, as a change may affect a group that extends far.

        Parameters
        ----------
        region
            The cells that the layers below have changed.

        """
        return Region.whole(self._node.grid)

    def apply(self, grid: Costmap2D, region: Region) -> None:
        """
        Remove small groups of obstacles, in place.

        Parameters
        ----------
        grid, region
            As for `Layer.apply`.

        """
        values = self._settings.current
        if values.minimal_group_size > 1:
            remove_small_groups(
                grid.cells[region.slices],
                values.minimal_group_size,
                values.group_connectivity_type,
            )
