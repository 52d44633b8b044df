# SPDX-License-Identifier: Apache-2.0
"""The costmap filter that keeps the robot out of areas of a mask."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from nav2_costmap_2d.costmap_filters import CostmapFilter, FilterParameters, UNKNOWN
from nav2_costmap_2d.costs import LETHAL_OBSTACLE, NO_INFORMATION
from nav2_costmap_2d.footprint import transformed
from nav2_costmap_2d.grid import CellArray, Costmap2D
from nav2_costmap_2d.regions import Region, write_maximum
from nav2_util.geometry import Pose2D
from nav2_util.parameters import parameter
import numpy as np

if TYPE_CHECKING:
    from nav2_costmap_2d.costmap_node import Costmap2DROS

__all__ = ['KeepoutFilter']

_KEEPOUT = 0
"""The type of CostmapFilterInfo."""


@dataclass(frozen=True)
class KeepoutParameters(FilterParameters):
    """The parameters of `nav2_costmap_2d::KeepoutFilter`."""

    override_lethal_cost: bool = parameter(
        False, 'Whether the robot may leave a keepout area in which it is.'
    )
    lethal_override_cost: int = parameter(
        252, 'The cost of keepout areas while the robot is in one and may leave.', low=0, high=252
    )


class KeepoutFilter(CostmapFilter):
    """
    Keepout filter: marks areas as obstacles, or changes their cost.

    Parameters
    ----------
    node, name
        As for `CostmapFilter`.

    Raises
    ------
    ConfigurationError
        `filter_info_topic` is not set.

    """

    parameters_kind = KeepoutParameters
    types = (_KEEPOUT,)

    def __init__(self, node: Costmap2DROS, name: str) -> None:
        super().__init__(node, name)
        occupancies = np.arange(256)
        self._table = np.rint(np.minimum(occupancies, 100) * LETHAL_OBSTACLE / 100.0).astype(
            np.uint8
        )
        self._table[UNKNOWN] = NO_INFORMATION
        self._pose: Pose2D | None = None
        self._robot: Pose2D | None = None

    def update(self, grid: Costmap2D, robot: Pose2D | None) -> Region | None:
        """
        Check whether the mask has moved, or the exemption of a trapped robot has changed.

        Parameters
        ----------
        grid, robot
            As for `Layer.update`.

        Returns
        -------
        Region or None
            All cells if so; None otherwise.

        """
        if self._mask is None:
            return None
        before, self._pose = (self._pose, self._robot is None), self._pose_in_mask()
        self._robot = self._trapped(grid, robot)
        after = (self._pose, self._robot is None)
        return Region.whole(grid) if after != before else None

    def apply(self, grid: Costmap2D, region: Region) -> None:
        """
        Raise the costs to those of the mask, in place.

        Parameters
        ----------
        grid, region
            As for `Layer.apply`.

        """
        if self._mask is None or self._pose is None:
            return
        columns, rows = np.meshgrid(
            np.arange(region.x, region.x_end), np.arange(region.y, region.y_end)
        )
        points = grid.map_to_world_array(np.stack([columns, rows], axis=-1))
        values = self._mask.costs_at(transformed(points, *self._pose), outside=UNKNOWN)
        costs: CellArray = self._table[values]
        if self._robot is not None:
            costs[costs == LETHAL_OBSTACLE] = self._settings.current.lethal_override_cost
        write_maximum(grid.cells[region.slices], costs)

    def _trapped(self, grid: Costmap2D, robot: Pose2D | None) -> Pose2D | None:
        """Return the pose of a robot that is trapped in a keepout zone and may leave it."""
        if not self._settings.current.override_lethal_cost or robot is None:
            return None
        if self._mask is None or self._pose is None:
            return None
        at = self._pose @ robot
        value = int(self._mask.costs_at(np.array([at.x, at.y]), outside=UNKNOWN))
        return robot if self._table[value] == LETHAL_OBSTACLE else None
