# SPDX-License-Identifier: Apache-2.0
"""Cost values of a costmap, and their scale in OccupancyGrid messages."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

__all__ = [
    'FREE_SPACE',
    'INSCRIBED_INFLATED_OBSTACLE',
    'LETHAL_OBSTACLE',
    'MAX_NON_OBSTACLE',
    'NO_INFORMATION',
    'cost_table',
    'occupancy_of',
]

FREE_SPACE = 0
"""The cost of free cells."""
MAX_NON_OBSTACLE = 252
"""The maximum cost of a cell in which the robot's centre may be, whatever its heading."""
INSCRIBED_INFLATED_OBSTACLE = 253
"""A robot whose centre is in the cell collides, whatever its heading."""
LETHAL_OBSTACLE = 254
"""The cell contains an obstacle."""
NO_INFORMATION = 255
"""The cell is unknown."""

CellArray = npt.NDArray[np.uint8]

_UNKNOWN_OCCUPANCY = -1


def _make_occupancies() -> npt.NDArray[np.int8]:
    table = np.zeros(256, dtype=np.int8)
    table[1:INSCRIBED_INFLATED_OBSTACLE] = 1 + 97 * np.arange(MAX_NON_OBSTACLE) // 251
    table[INSCRIBED_INFLATED_OBSTACLE] = 99
    table[LETHAL_OBSTACLE] = 100
    table[NO_INFORMATION] = _UNKNOWN_OCCUPANCY
    return table


_OCCUPANCIES = _make_occupancies()


def occupancy_of(cells: CellArray) -> npt.NDArray[np.int8]:
    """
    Convert costs to the scale of OccupancyGrid that costmaps are published in.

    Parameters
    ----------
    cells
        Costs, of any shape.

    Returns
    -------
    The same shape: 0 where free, 1 to 98 for the costs from 1 to 252, 99 where the inscribed
    circle collides, 100 at obstacles, -1 where unknown.

    """
    return _OCCUPANCIES[cells]


def cost_table(
    lethal_threshold: int, unknown_value: int, *, track_unknown: bool, trinary: bool
) -> CellArray:
    """
    Make the lookup table from a map's occupancy to costs.

    Parameters
    ----------
    lethal_threshold
        The occupancy from which a cell is an obstacle, from 0 to 100.
    unknown_value
        The occupancy, as an unsigned byte, of unknown cells: 255 for -1.
    track_unknown
        Whether such cells get NO_INFORMATION; otherwise they are free.
    trinary
        Whether cells below the threshold are free; otherwise their cost is proportional.

    Returns
    -------
    (256,) costs, to be indexed with the occupancy as an unsigned byte.

    """
    occupancies = np.arange(256)
    threshold = min(max(lethal_threshold, 0), 100)
    table = np.full(256, FREE_SPACE, dtype=np.uint8)
    if not trinary and threshold:
        below = occupancies < threshold
        table[below] = (occupancies[below] * LETHAL_OBSTACLE / threshold).astype(np.uint8)
    table[threshold:] = LETHAL_OBSTACLE
    table[unknown_value & 0xFF] = NO_INFORMATION if track_unknown else FREE_SPACE
    return table
