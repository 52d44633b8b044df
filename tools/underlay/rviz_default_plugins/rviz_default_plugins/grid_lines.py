# SPDX-License-Identifier: Apache-2.0
"""The lines of a grid."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ['GridSize', 'in_pieces', 'lines']

AXES = {'XY': (0, 1, 2), 'XZ': (0, 2, 1), 'YZ': (1, 2, 0)}
"""The indices of the two in-plane coordinates of a grid, and of its normal."""


@dataclass(frozen=True)
class GridSize:
    """The number of square cells of a grid in its plane and across it, and their size."""

    cells: int
    layers: int
    cell_m: float

    @property
    def line_count(self) -> int:
        """The number of lines."""
        across = (self.cells + 1) ** 2 if self.layers else 0
        return 2 * (self.cells + 1) * (self.layers + 1) + across

    def within(self, limit: int) -> GridSize:
        """
        Find a grid with as many cells as possible, but no more lines than a limit.

        Parameters
        ----------
        limit
            The maximum number of lines; at most an eighth of it are layers.

        Returns
        -------
        GridSize
            The grid, with cells of the same size.

        """
        layers = min(self.layers, limit // 8)
        fitting, too_many = 1, self.cells + 1
        while too_many - fitting > 1:
            cells = (fitting + too_many) // 2
            if GridSize(cells, layers, self.cell_m).line_count <= limit:
                fitting = cells
            else:
                too_many = cells
        return GridSize(fitting, layers, self.cell_m)


def lines(size: GridSize, plane: str) -> NDArray[np.float32]:
    """
    Compute the lines of a grid around the origin.

    Parameters
    ----------
    size
        The size of the grid.
    plane
        The plane that it is in: `XY`, `XZ` or `YZ`.

    Returns
    -------
    NDArray[np.float32]
        The ends of N lines (N, 2, 3), in m.

    """
    first, second, across = AXES[plane]
    steps = _steps(size.cells, size.cell_m)
    heights = _steps(size.layers, size.cell_m)
    both_ends = steps[[0, -1]]
    groups = [
        _group(first, both_ends, second, steps, across, heights),
        _group(second, both_ends, first, steps, across, heights),
    ]
    if size.layers:
        groups.append(_group(across, heights[[0, -1]], first, steps, second, steps))
    return np.concatenate(groups)


def in_pieces(whole: NDArray[np.float32], count: int) -> NDArray[np.float32]:
    """
    Cut each line into pieces of the same length.

    A browser misjudges the depth of a line that starts behind the viewer: short lines avoid this.

    Parameters
    ----------
    whole
        The ends of N lines (N, 2, 3).
    count
        The number of pieces of each.

    Returns
    -------
    NDArray[np.float32]
        The ends of the pieces (N count, 2, 3).

    """
    shares = np.linspace(0.0, 1.0, count + 1, dtype=np.float32)[:, None]
    points = whole[:, None, 0] + shares * (whole[:, None, 1] - whole[:, None, 0])
    return np.stack([points[:, :-1], points[:, 1:]], axis=2).reshape(-1, 2, 3)


def _steps(count: int, length: float) -> NDArray[np.float32]:
    half = count / 2.0
    return np.linspace(-half * length, half * length, count + 1, dtype=np.float32)


def _group(
    along: int,
    ends: NDArray[np.float32],
    first: int,
    first_steps: NDArray[np.float32],
    second: int,
    second_steps: NDArray[np.float32],
) -> NDArray[np.float32]:
    """Return parallel lines, one for each pair of steps."""
    a, b = (each.ravel() for each in np.meshgrid(first_steps, second_steps))
    found = np.empty((len(a), 2, 3), np.float32)
    found[:, :, along] = ends
    found[:, :, first] = a[:, None]
    found[:, :, second] = b[:, None]
    return found
