# SPDX-License-Identifier: Apache-2.0
"""A turtle that goes round a square, as far as it knows where it is."""

from __future__ import annotations

import pytest
from turtlesim_py.square import Square
from turtlesim_py.world import CENTRE, World

CORNERS = [(2.0, 0.0), (2.0, 2.0), (0.0, 2.0), (0.0, 0.0)]


@pytest.mark.parametrize('late', [0, 3])
def test_it_comes_to_each_corner(late: int) -> None:
    """Also with poses that are late, it stops at each corner of two rounds, and goes on."""
    world, square = World(0.0), Square()
    turtle = world.reset()
    poses = [(turtle.x, turtle.y, turtle.theta)] * (late + 1)
    reached: list[tuple[float, float]] = []
    for tick in range(1, 5000):
        if len(reached) == 8:
            break
        corner = square.corner
        world.command('turtle1', square.velocity_at(*poses[-1 - late]), tick * 0.016)
        poses.append((turtle.x, turtle.y, turtle.theta))
        if square.corner != corner:
            reached.append((turtle.x - CENTRE, turtle.y - CENTRE))
            assert reached[-1] == pytest.approx(CORNERS[len(reached) % 4 - 1], abs=0.02)
    assert len(reached) == 8
