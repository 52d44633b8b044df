# SPDX-License-Identifier: Apache-2.0
"""
How layers make a costmap: each says what it has changed, and only that is made anew.

The idea is from D. V. Lu, D. Hershberger, W. D. Smart: Layered Costmaps for Context-Sensitive
Navigation. IROS 2014.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from nav2_costmap_2d.costs import NO_INFORMATION
from nav2_costmap_2d.footprint import Footprint
from nav2_costmap_2d.grid import CellArray, Costmap2D
from nav2_util.geometry import Pose2D
import numpy as np
import numpy.typing as npt

__all__ = ['Layer', 'LayeredCostmap', 'Region', 'forget_cells', 'write_maximum', 'write_over']


class Region(NamedTuple):
    """A rectangle of cells; the ends are exclusive."""

    x: int
    y: int
    x_end: int
    y_end: int

    @classmethod
    def whole(cls, grid: Costmap2D) -> Region:
        """
        Return the region of all cells of a grid.

        Parameters
        ----------
        grid
            Only its size counts.

        """
        return cls(0, 0, grid.size_x, grid.size_y)

    @classmethod
    def of_mask(cls, mask: npt.NDArray[np.bool_]) -> Region | None:
        """
        Return the smallest region with all cells that are set.

        Parameters
        ----------
        mask
            Which cells are set (rows, columns).

        Returns
        -------
        Region or None
            None if no cell is set.

        """
        rows = mask.any(axis=1).nonzero()[0]
        if not len(rows):
            return None
        columns = mask[slice(rows[0], rows[-1] + 1)].any(axis=0).nonzero()[0]
        return cls(int(columns[0]), int(rows[0]), int(columns[-1]) + 1, int(rows[-1]) + 1)

    @property
    def slices(self) -> tuple[slice, slice]:
        """Return the index of the region in an array of cells."""
        return slice(self.y, self.y_end), slice(self.x, self.x_end)

    def union(self, other: Region | None) -> Region:
        """
        Return the smallest region that contains both.

        Parameters
        ----------
        other
            The other one; None for nothing.

        """
        if other is None:
            return self
        return Region(
            min(self.x, other.x),
            min(self.y, other.y),
            max(self.x_end, other.x_end),
            max(self.y_end, other.y_end),
        )

    def grown(self, cells: int) -> Region:
        """
        Return the region with a margin, perhaps beyond the grid.

        Parameters
        ----------
        cells
            The width of the margin on each side.

        """
        return Region(self.x - cells, self.y - cells, self.x_end + cells, self.y_end + cells)

    def clipped(self, grid: Costmap2D) -> Region | None:
        """
        Return the part of the region that is in a grid.

        Parameters
        ----------
        grid
            Only its size counts.

        Returns
        -------
        Region or None
            None if nothing is in it.

        """
        found = Region(
            max(self.x, 0),
            max(self.y, 0),
            min(self.x_end, grid.size_x),
            min(self.y_end, grid.size_y),
        )
        return found if found.x < found.x_end and found.y < found.y_end else None


def write_maximum(cells: CellArray, added: CellArray, *, keep_unknown: bool = False) -> None:
    """
    Raise costs to others of the same shape, in place; unknown is less than free here.

    Parameters
    ----------
    cells, added
        Costs; where `added` is NO_INFORMATION nothing changes.
    keep_unknown
        Whether cells of which nothing is known stay so.

    """
    highest: CellArray = np.maximum(cells + np.uint8(1), added + np.uint8(1)) - np.uint8(1)
    if keep_unknown:
        np.copyto(cells, highest, where=cells != NO_INFORMATION)
    else:
        cells[...] = highest


def write_over(cells: CellArray, added: CellArray) -> None:
    """
    Replace costs by others that are known, in place.

    Parameters
    ----------
    cells, added
        Costs of the same shape; where `added` is NO_INFORMATION nothing changes.

    """
    np.copyto(cells, added, where=added != NO_INFORMATION)


def forget_cells(grid: Costmap2D, region: Region, is_inverted: bool) -> None:
    """
    Set costs to NO_INFORMATION, in place.

    Parameters
    ----------
    grid
        The grid that is changed.
    region
        The cells to forget, perhaps beyond the grid.
    is_inverted
        Whether all but the region is forgotten.

    """
    inside = region.clipped(grid)
    if inside is None:
        if is_inverted:
            grid.cells[...] = NO_INFORMATION
        return
    kept = grid.cells[inside.slices].copy()
    if is_inverted:
        grid.cells[...] = NO_INFORMATION
        grid.cells[inside.slices] = kept
    else:
        grid.cells[inside.slices] = NO_INFORMATION


class Layer:
    """
    A layer of a costmap; the base does nothing.

    Parameters
    ----------
    name
        Its name in the list `plugins`.

    """

    is_clearable = False
    """Whether services that clear a costmap clear this layer."""

    def __init__(self, name: str) -> None:
        self.name = name

    @property
    def is_enabled(self) -> bool:
        """Whether it takes part."""
        return True

    @property
    def is_current(self) -> bool:
        """Whether it has the data that it needs, and those are not too old."""
        return True

    def match(self, grid: Costmap2D) -> None:
        """
        Take another size or place of the costmap.

        Parameters
        ----------
        grid
            The new costmap; its costs do not count.

        """

    def set_footprint(self, footprint: Footprint) -> None:
        """
        Take another shape of the robot.

        Parameters
        ----------
        footprint
            The new shape, with padding.

        """

    def update(self, grid: Costmap2D, robot: Pose2D | None) -> Region | None:
        """
        Take what is new.

        Parameters
        ----------
        grid
            The costmap as it was; only its size and place count.
        robot
            Where the robot is, in the frame of the costmap, if that is known.

        Returns
        -------
        Which cells are to be made anew; None if nothing has changed.

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
            The cells that have to be made anew, perhaps beyond the grid.

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
        Return the costs of the layer itself.

        Parameters
        ----------
        grid
            The costmap, for its size and place.

        Returns
        -------
        Costmap2D or None
            A grid of that size; None for a layer without costs of its own.

        """
        return None

    def clear(self, region: Region | None, *, is_inverted: bool = False) -> None:
        """
        Forget what sensors have seen.

        Parameters
        ----------
        region
            The cells to forget; None for everything.
        is_inverted
            Whether all but the region is forgotten.

        """


class LayeredCostmap:
    """
    A costmap that is made of layers.

    Parameters
    ----------
    grid
        Its size and place at first.
    default_cost
        What cells cost of which no layer says anything.
    is_rolling
        Whether the robot stays in the middle.

    """

    def __init__(self, grid: Costmap2D, default_cost: int, is_rolling: bool) -> None:
        self.grid = grid
        """The newest costmap: replaced as a whole, and never changed."""
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
        Take another size or place; the costs come with the next update.

        Parameters
        ----------
        grid
            The new costmap, which stands until then.

        """
        self.grid = self._below_filters = grid
        for layer in self.everything:
            layer.match(grid)
        self.touch()

    def touch(self) -> None:
        """Make everything anew in the next update."""
        self._is_stale = True

    def clear(self, region_of: Callable[[Costmap2D], Region] | None, is_inverted: bool) -> None:
        """
        Forget what sensors have seen, in all layers that are clearable.

        Parameters
        ----------
        region_of
            Returns the region of a costmap; None for everything.
        is_inverted
            Whether all but the region is forgotten.

        """
        region = None if region_of is None else region_of(self.grid)
        for layer in self.layers:
            if layer.is_clearable:
                layer.clear(region, is_inverted=is_inverted)
        self.touch()

    def update(self, robot: Pose2D | None) -> Region | None:
        """
        Make anew what has changed.

        Parameters
        ----------
        robot
            Where the robot is in the frame of the costmap, if that is known.

        Returns
        -------
        The cells that are new; None if there are none.

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
        """Move the costmap by whole cells, so that the robot is in the middle."""
        grid = self.grid
        dx, dy = grid.snapped(robot.x - 0.5 * grid.size_x_m, robot.y - 0.5 * grid.size_y_m)
        if dx or dy:
            self.resize(grid.shifted(dx, dy, self.default_cost))
