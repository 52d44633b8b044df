# SPDX-License-Identifier: Apache-2.0
"""Rectangles of cells, and writing costs into them."""

from __future__ import annotations

from typing import NamedTuple

from nav2_costmap_2d.costs import NO_INFORMATION
from nav2_costmap_2d.grid import CellArray, Costmap2D
import numpy as np
import numpy.typing as npt

__all__ = ['Region', 'forget_cells', 'write_maximum', 'write_over']


class Region(NamedTuple):
    """A rectangle of cells; the ends are exclusive."""

    x: int
    y: int
    x_end: int
    y_end: int

    @classmethod
    def whole(cls, grid: Costmap2D) -> Region:
        """
        Make the region of all cells of a grid.

        Parameters
        ----------
        grid
            The grid, for its size.

        """
        return cls(0, 0, grid.size_x, grid.size_y)

    @classmethod
    def of_mask(cls, mask: npt.NDArray[np.bool_]) -> Region | None:
        """
        Compute the bounding region of all set cells.

        Parameters
        ----------
        mask
            Mask of the set cells (rows, columns).

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
        """Return the slices that index an array of cells."""
        return slice(self.y, self.y_end), slice(self.x, self.x_end)

    def union(self, other: Region | None) -> Region:
        """
        Compute the bounding region of both.

        Parameters
        ----------
        other
            The other one; None if empty.

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
        Extend the region by a margin, possibly beyond the grid.

        Parameters
        ----------
        cells
            The width of the margin on each side.

        """
        return Region(self.x - cells, self.y - cells, self.x_end + cells, self.y_end + cells)

    def clipped(self, grid: Costmap2D) -> Region | None:
        """
        Clip the region to a grid.

        Parameters
        ----------
        grid
            The grid, for its size.

        Returns
        -------
        Region or None
            None if they do not overlap.

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
    Merge costs by the maximum, in place; unknown ranks below free.

    Parameters
    ----------
    cells, added
        Costs of the same shape; where `added` is NO_INFORMATION nothing changes.
    keep_unknown
        Whether unknown cells stay unknown.

    """
    highest: CellArray = np.maximum(cells + np.uint8(1), added + np.uint8(1)) - np.uint8(1)
    if keep_unknown:
        np.copyto(cells, highest, where=cells != NO_INFORMATION)
    else:
        cells[...] = highest


def write_over(cells: CellArray, added: CellArray) -> None:
    """
    Overwrite costs by others that are known, in place.

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
        The grid, modified in place.
    region
        The cells to clear, possibly beyond the grid.
    is_inverted
        Whether to clear everything except for the region.

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
