# SPDX-License-Identifier: Apache-2.0
"""Positions, rotations and bodies."""

from geometry_msgs.msg import Point, Quaternion
import numpy as np
import pytest
from rviz_default_plugins.bodies import arrow, cone, cube, revolved, sphere
from rviz_default_plugins.decoding.geometry import (
    along_x,
    finite_points_of,
    from_axes,
    joined,
    points_of,
    position,
    rotated,
    rotation,
    rotations_of,
)
from rviz_default_plugins.displays.pose import ellipsoid_of

HALF = 0.5**0.5


def test_position_that_is_nowhere_is_refused():
    """A position with a number that is not finite has a sentence with the numbers."""
    assert position(Point(x=1.0, y=2.0, z=3.0)) == (1.0, 2.0, 3.0)
    with pytest.raises(ValueError, match='its position is nan, 2, 0, which is out of range'):
        position(Point(x=float('nan'), y=2.0))


def test_rotation_has_length_one():
    """Quaternions are made to have length 1; those of zeros and infinities are refused."""
    assert rotation(Quaternion(x=0.0, y=0.0, z=2.0, w=2.0)) == pytest.approx((HALF, 0, 0, HALF))
    with pytest.raises(ValueError, match='quaternion of zeros'):
        rotation(Quaternion(x=0.0, y=0.0, z=0.0, w=0.0))
    with pytest.raises(ValueError, match='not finite'):
        rotation(Quaternion(w=float('inf')))


def test_rotations_of_many():
    """Rotations of many come with what tells which of them are rotations."""
    rows, valid = rotations_of([Quaternion(w=2.0), Quaternion(w=0.0), Quaternion(w=float('nan'))])
    assert valid.tolist() == [True, False, False]
    assert rows.tolist() == [[1, 0, 0, 0]] * 3
    assert rotations_of([])[0].shape == (0, 4)


def test_points_become_rows():
    """Points become rows, also none of them; those that are nowhere are counted."""
    points = [Point(x=1.0, y=2.0, z=3.0), Point(z=float('inf'))]
    assert points_of(points[:1]).tolist() == [[1, 2, 3]]
    assert points_of([]).shape == (0, 3)
    with pytest.raises(ValueError, match='1 of its 2 points'):
        finite_points_of(points)


def test_turning_points():
    """A quarter turn around z takes x to y; two of them are a half turn."""
    quarter = (HALF, 0.0, 0.0, HALF)
    assert rotated(np.eye(3), quarter) == pytest.approx(
        np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1]])
    )
    assert joined(quarter, quarter) == pytest.approx((0, 0, 0, 1))


@pytest.mark.parametrize('direction', [(1, 0, 0), (-1, 0, 0), (0, 2, 0), (0, 0, -3), (1, 1, 1)])
def test_along_x_turns_x_there(direction):
    """The rotation takes the x axis to the direction, also to the opposite one."""
    there = rotated(np.array([[1.0, 0.0, 0.0]]), along_x(direction))[0]
    assert there == pytest.approx(np.array(direction) / np.linalg.norm(direction))


def test_from_axes_is_the_rotation_of_a_matrix():
    """The quaternion turns the unit vectors to the columns."""
    turn = (0.5, -0.5, 0.1, 0.7)
    turn = tuple(np.array(turn) / np.linalg.norm(turn))
    columns = rotated(np.eye(3), turn).T
    assert rotated(np.eye(3), from_axes(columns)).T == pytest.approx(columns)


def test_ellipsoid_has_standard_deviations_as_half_axes():
    """Half axes are roots of the variances, turned as they belong together."""
    covariance = np.zeros((6, 6))
    covariance[:3, :3] = np.diag([4.0, 1.0, 0.0])
    ellipsoid = ellipsoid_of(covariance.reshape(-1))
    tips = rotated(np.diag(ellipsoid.radii), ellipsoid.wxyz)
    assert sorted(np.abs(tips).max(axis=0)) == pytest.approx([0, 1, 2])
    assert np.abs(tips).max(axis=0)[0] == pytest.approx(2.0)


def test_ellipsoid_of_no_covariance_is_refused():
    """Negative variances and numbers that are not finite are refused."""
    with pytest.raises(ValueError, match='negative'):
        ellipsoid_of([-1.0] + [0.0] * 35)
    with pytest.raises(ValueError, match='not finite'):
        ellipsoid_of([float('nan')] * 36)
    with pytest.raises(ValueError, match='too large'):
        ellipsoid_of([1e308] * 36)


def volume(surface):
    """Return the volume inside of a surface whose faces look outwards."""
    a, b, c = (surface.vertices[surface.faces[:, corner]].astype(float) for corner in range(3))
    return float((a * np.cross(b, c)).sum() / 6.0)


@pytest.mark.parametrize(
    ('surface', 'expected'),
    [
        (cube(), 1.0),
        (sphere(16), np.pi / 6.0),
        (cone(2.0, 1.0), np.pi * 2.0 / 3.0),
        (arrow(1.0, 0.1, 0.3, 0.2), np.pi * (0.01 + 0.3 * 0.04 / 3.0)),
        (revolved(((0.0, 0.0), (0.0, 1.0), (1.0, 1.0), (1.0, 0.0)), 64), np.pi),
    ],
)
def test_surfaces_are_closed_and_look_outwards(surface, expected):
    """Bodies have about the volume that they should have, with the sign of faces outwards."""
    assert volume(surface) == pytest.approx(expected, rel=0.12)


def test_arrow_begins_at_the_origin_and_ends_at_its_tip():
    """An arrow reaches from 0 to the sum of its lengths along x."""
    along = arrow(1.0, 0.1, 0.25, 0.2).vertices[:, 0]
    assert (along.min(), along.max()) == (0.0, 1.25)
