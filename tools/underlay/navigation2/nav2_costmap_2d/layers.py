# SPDX-License-Identifier: Apache-2.0
"""
Layered costmap: each layer reports its changed region, and only that is updated.

The idea is from D. V. Lu, D. Hershberger, W. D. Smart: Layered Costmaps for Context-Sensitive
Navigation. IROS 2014.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from nav2_costmap_2d.footprint import Footprint
from nav2_costmap_2d.grid import Costmap2D
from nav2_costmap_2d.regions import Region
from nav2_util.geometry import Pose2D

__all__ = ['Layer', 'LayeredCostmap']


class Layer:
    """
    Base class of costmap layers, which does nothing.

    Parameters
    ----------
    name
        Its name in the list `plugins`.

    """

    is_clearable = False
    """Whether the services that clear a costmap clear this layer."""

    def __init__(self, name: str) -> None:
        self.name = name

    @property
    def is_enabled(self) -> bool:
        """Whether the layer is enabled."""
        return True

    @property
    def is_current(self) -> bool:
        """Whether the data of the layer are available and recent."""
        return True

    def match(self, grid: Costmap2D) -> None:
        """
        Match a new size or origin of the costmap.

        Parameters
        ----------
        grid
            The new costmap; its costs are ignored.

        """

    def set_footprint(self, footprint: Footprint) -> None:
        """
        Set the footprint of the robot.

        Parameters
        ----------
        footprint
            The new footprint, with padding.

        """

    def update(self, grid: Costmap2D, robot: Pose2D | None) -> Region | None:
        """
        Process new data.

        Parameters
        ----------
        grid
            The previous costmap, for its size and origin.
        robot
            The pose of the robot in the frame of the costmap, if available.

        Returns
        -------
        The cells to update; None if nothing has changed.

        """
        return None

    def affected(self, region: Region) -> Region:
        """
        Extend a changed region to all cells that depend on it.

        Parameters
        ----------
        region
            The cells that layers below have changed.

        Returns
        -------
        Region
            The cells to update, possibly beyond the grid.

        """
        return region

    def apply(self, grid: Costmap2D, region: Region) -> None:
        """
        Write the layer into a region of the costmap, in place.

        Parameters
        ----------
        grid
            The costmap, to which the layers below have been applied.
        region
            The cells to write.

        """

    def costs(self, grid: Costmap2D) -> Costmap2D | None:
        """
        Return the costs of this layer alone.

        Parameters
        ----------
        grid
            The costmap, for its size and origin.

        Returns
        -------
        Costmap2D or None
            A grid of that size; None for a layer without its own costs.

        """
        return None

    def clear(self, region: Region | None, *, is_inverted: bool = False) -> None:
        """
        Clear the data of sensors.

        Parameters
        ----------
        region
            The cells to clear; None for everything.
        is_inverted
            Whether to clear everything except for the region.

        """


class LayeredCostmap:
    """
    Layered costmap.

    Parameters
    ----------
    grid
        Its initial size and origin.
    default_cost
        The cost of cells that no layer sets.
    is_rolling
        Whether the costmap follows the robot.

    """

    def __init__(self, grid: Costmap2D, default_cost: int, is_rolling: bool) -> None:
        self.grid = grid
        """The newest costmap: replaced as a whole, never modified."""
        self.default_cost = default_cost
        self.is_rolling = is_rolling
        self.layers: list[Layer] = []
        self.filters: list[Layer] = []
        self._below_filters = grid
        self._enabled: list[bool] = []
        self._is_stale = True

    @property
    def everything(self) -> Sequence[Layer]:
        """Return the layers and the filters."""
        return [*self.layers, *self.filters]

    def resize(self, grid: Costmap2D) -> None:
        """
        Change the size or origin; the costs follow with the next update.

        Parameters
        ----------
        grid
            The new costmap, used until then.

        """
        self.grid = self._below_filters = grid
        for layer in self.everything:
            layer.match(grid)
        self.touch()

    def touch(self) -> None:
        """Mark everything for the next update."""
        self._is_stale = True

    def clear(self, region_of: Callable[[Costmap2D], Region] | None, is_inverted: bool) -> None:
        """
        Clear the data of sensors in all clearable layers.

        Parameters
        ----------
        region_of
            Function that returns the region of a costmap; None for everything.
        is_inverted
            Whether to clear everything except for the region.

        """
        region = None if region_of is None else region_of(self.grid)
        for layer in self.layers:
            if layer.is_clearable:
                layer.clear(region, is_inverted=is_inverted)
        self.touch()

    def update(self, robot: Pose2D | None) -> Region | None:
        """
        Update the cells that have changed.

        Parameters
        ----------
        robot
            The pose of the robot in the frame of the costmap, if available.

        Returns
        -------
        The updated cells; None if there are none.

        """
        if self.is_rolling:
            if robot is None:
                return None
            self._follow(robot)
        enabled = [layer.is_enabled for layer in self.everything]
        if enabled != self._enabled:
            self._enabled, self._is_stale = enabled, True
        region: Region | None = None
        for layer in self.everything:
            if layer.is_enabled:
                found = layer.update(self.grid, robot)
                region = found if region is None else region.union(found)
        if self._is_stale:
            region, self._is_stale = Region.whole(self.grid), False
        if region is None:
            return None
        for layer in self.everything:
            if layer.is_enabled:
                region = layer.affected(region)
        region = region.clipped(self.grid)
        if region is not None:
            self._make(region)
        return region

    def _make(self, region: Region) -> None:
        grid = self._below_filters.copy()
        grid.cells[region.slices] = self.default_cost
        for layer in self.layers:
            if layer.is_enabled:
                layer.apply(grid, region)
        self._below_filters = grid
        if any(layer.is_enabled for layer in self.filters):
            filtered = self.grid.copy()
            filtered.cells[region.slices] = grid.cells[region.slices]
            for layer in self.filters:
                if layer.is_enabled:
                    layer.apply(filtered, region)
            grid = filtered
        self.grid = grid

    def _follow(self, robot: Pose2D) -> None:
        """Shift the costmap by whole cells to centre it on the robot."""
        grid = self.grid
        dx, dy = grid.snapped(robot.x - 0.5 * grid.size_x_m, robot.y - 0.5 * grid.size_y_m)
        if dx or dy:
            self.resize(grid.shifted(dx, dy, self.default_cost))
