# SPDX-License-Identifier: Apache-2.0
"""How much room a map leaves."""

from __future__ import annotations

import math

from humanoid_manipulation.free_floor import FreeFloor
from nav_msgs.msg import OccupancyGrid
import numpy as np
import pytest

CELL_M = 0.05
LEFT, RIGHT = (1.0, 1.5), (5.0, 1.5)


def two_rooms(door_m: float) -> OccupancyGrid:
    """Return the map of two rooms of 3 m, and a door between them at y 1.5."""
    cells = np.full((60, 120), 0, dtype=np.int8)
    cells[[0, -1], :] = cells[:, [0, -1]] = 100
    cells[:, 59:61] = 100
    begin = 30 - round(0.5 * door_m / CELL_M)
    cells[begin:-begin, 59:61] = 0
    grid = OccupancyGrid(data=cells.ravel().tolist())
    grid.info.resolution, grid.info.width, grid.info.height = CELL_M, 120, 60
    return grid


def test_how_far_what_is_mapped_is() -> None:
    """A wall, somebody who stands there, and where the map ends."""
    floor = FreeFloor(two_rooms(0.9), [(2.0, 2.0, 0.25)])
    assert floor.room_m((0.55, 1.5)) == pytest.approx(0.525, abs=CELL_M)
    assert floor.room_m((1.5, 2.0)) == pytest.approx(0.25, abs=CELL_M)
    assert floor.room_m((2.0, 2.0)) == 0.0
    assert floor.room_m((-5.0, 1.5)) == floor.room_m((50.0, 1.5)) == 0.0


@pytest.mark.parametrize('door_m, is_wide', [(0.9, True), (0.7, False)])
def test_a_narrow_door_is_no_wide_way(door_m: float, is_wide: bool) -> None:
    """There is a way all the same."""
    floor = FreeFloor(two_rooms(door_m), [])
    assert floor.is_wide_way(LEFT, RIGHT) is is_wide
    assert floor.is_clear_way(LEFT, RIGHT)
    assert floor.is_wide_way(LEFT, (0.2, 0.2)), 'In a corner, it counts from beside it.'


def test_somebody_in_the_door_is_in_the_way() -> None:
    """Neither straight, nor on any way."""
    floor = FreeFloor(two_rooms(0.9), [(3.0, 1.5, 0.25)])
    assert not floor.is_clear_way(LEFT, RIGHT)
    assert not floor.is_wide_way(LEFT, RIGHT)


def test_without_a_map_all_is_free() -> None:
    """As far as anybody knows."""
    floor = FreeFloor(OccupancyGrid(), [(3.0, 1.5, 0.25)])
    assert floor.room_m(LEFT) == math.inf
    assert floor.is_clear_way(LEFT, RIGHT) and floor.is_wide_way(LEFT, RIGHT)
