# SPDX-License-Identifier: Apache-2.0
"""Check the area in which the ground carries the robot."""

from __future__ import annotations

from humanoid_control.walking.errors import WalkingError
from humanoid_control.walking.support_polygon import SupportPolygon
import numpy as np
import pytest

SQUARE = SupportPolygon([0j, 1 + 0j, 1 + 1j, 1j, 0.5 + 0.5j])
RANDOM = np.random.default_rng(3)


def test_inner_points_are_no_corners() -> None:
    """A polygon has the corners of the hull alone, anticlockwise."""
    assert set(SQUARE.corners) == {0j, 1 + 0j, 1 + 1j, 1j}


@pytest.mark.parametrize('point', [0.2 + 0.7j, 0j, 0.5 + 0j])
def test_points_inside_stay(point: complex) -> None:
    """A point inside or on the edge is not moved."""
    assert SQUARE.contains(point)
    assert SQUARE.clamped(point) == point


@pytest.mark.parametrize(
    ('point', 'expected'),
    [(2 + 0.5j, 1 + 0.5j), (0.3 - 4j, 0.3 + 0j), (-1 - 1j, 0j), (3 + 2j, 1 + 1j)],
)
def test_points_outside_come_to_the_edge(point: complex, expected: complex) -> None:
    """A point outside goes to the closest edge or corner."""
    assert not SQUARE.contains(point)
    assert SQUARE.clamped(point) == pytest.approx(expected)


def test_clamped_is_the_closest_point() -> None:
    """No point of a random polygon is closer than the one that is found."""
    for _ in range(30):
        corners = [complex(*RANDOM.normal(size=2)) for _ in range(8)]
        polygon = SupportPolygon(corners)
        point = complex(*RANDOM.normal(scale=4, size=2))
        found = polygon.clamped(point)
        weights = RANDOM.dirichlet(np.ones(8), size=200)
        distances = abs(weights @ np.array(corners) - point)
        assert abs(found - point) <= distances.min() + 1e-12


def test_a_line_is_refused() -> None:
    """Points on a line are nothing to stand on."""
    with pytest.raises(WalkingError, match='not a support polygon'):
        SupportPolygon([0j, 1 + 1j, 2 + 2j])
