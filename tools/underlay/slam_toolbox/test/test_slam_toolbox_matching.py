# SPDX-License-Identifier: Apache-2.0
"""Where a scan fits: search, refinement, and how sure that is."""

from __future__ import annotations

import numpy as np
import pytest
from slam_toolbox_py.matching import correlate, CorrelationSettings, refine, Surfaces
from slam_toolbox_py.poses import compose, relative, transform
from slam_toolbox_py.scans import surface_normals, take_scan
from slam_world import ANGLES, room, walls

PLACE = np.array([3.0, 2.5, 0.4])
FREE = np.diag([1.0, 1.0, 1.0])


@pytest.fixture(scope='module')
def world():
    return room()


@pytest.mark.parametrize(
    'offset', [(0.12, -0.08, 0.1), (-0.2, 0.15, -0.3), (0.0, 0.0, 0.0), (0.22, 0.22, 0.25)]
)
def test_known_offset_is_recovered_within_a_centimetre(world, offset):
    """Two scans with noise tell how the robot has moved between them."""
    rng = np.random.default_rng(5)
    place = compose(PLACE, np.array(offset))
    before, scan = world.scan(PLACE, rng), world.scan(place, rng)
    seen = Surfaces([(before, PLACE)])
    coarse = correlate(seen.points, scan.points, PLACE, CorrelationSettings())
    match = refine(seen, scan, coarse.pose, PLACE, FREE)
    away = relative(place, match.pose)
    assert np.hypot(*away[:2]) < 0.01
    assert abs(np.rad2deg(away[2])) < 0.2
    assert coarse.response > 0.7
    assert match.response > 0.7


def test_wide_search_finds_the_place(world):
    """The window of loops is searched coarse to fine."""
    rng = np.random.default_rng(6)
    guess = compose(PLACE, np.array([1.4, -0.7, 0.3]))
    scan = world.scan(PLACE, rng)
    seen = Surfaces([(world.scan(PLACE + [0.3, 0.1, 0.2], rng), PLACE + [0.3, 0.1, 0.2])])
    search = CorrelationSettings(half_window_m=2.0, smear_m=0.05, distance_variance=10.0)
    coarse = correlate(seen.points, scan.points, guess, search)
    assert np.hypot(*(coarse.pose - PLACE)[:2]) < 0.1
    assert abs(coarse.pose[2] - PLACE[2]) < 0.05


def test_nothing_to_match_with_is_no_match():
    """A scan without points, or nothing seen, has response 0 and stays at its guess."""
    match = correlate(np.zeros((0, 2)), np.ones((3, 2)), PLACE, CorrelationSettings())
    assert match.response == 0.0
    assert np.array_equal(match.pose, PLACE)
    empty = take_scan(np.full(360, np.inf), ANGLES, np.eye(3), np.zeros(3), 0.1, 12.0)
    assert not len(empty.points)
    refined = refine(Surfaces([]), empty, PLACE, PLACE, FREE)
    assert refined.response == 0.0
    assert np.allclose(refined.pose, PLACE)


def test_corridor_is_uncertain_along_itself():
    """In a corridor without features the guess decides along it, and the walls across it."""
    world = walls((30.0, 3.0), 0.02, [(0.0, 0.5, 30.0, 0.6), (0.0, 2.0, 30.0, 2.1)])
    rng = np.random.default_rng(7)
    first, second = np.array([10.0, 1.3, 0.0]), np.array([10.4, 1.3, 0.0])
    scan = world.scan(second, rng, range_max_m=6.0)
    seen = Surfaces([(world.scan(first, rng, range_max_m=6.0), first)])
    guess = np.array([10.45, 1.35, 0.05])
    match = refine(seen, scan, guess, guess, np.diag([400.0, 400.0, 100.0]))
    assert match.pose[0] == pytest.approx(10.45, abs=0.02)
    assert match.pose[1] == pytest.approx(1.3, abs=0.01)
    assert match.pose[2] == pytest.approx(0.0, abs=0.004)
    assert match.information[0, 0] < 0.1 * match.information[1, 1]


def test_normals_point_to_the_scanner():
    """Points on a wall have its normal, and single ones none."""
    points = np.stack([np.linspace(-1.0, 1.0, 41), np.full(41, 2.0)], axis=1)
    points = np.concatenate([points, [[5.0, 5.0]]])
    normals = surface_normals(points, np.zeros(2))
    assert np.allclose(normals[:-1], [0.0, -1.0])
    assert not normals[-1].any()


def test_tilted_scanner_is_projected():
    """A wall stays where it is when the torso leans by two degrees."""
    tilt = np.deg2rad(2.0)
    turn = np.array([[np.cos(tilt), 0, np.sin(tilt)], [0, 1, 0], [-np.sin(tilt), 0, np.cos(tilt)]])
    ranges = np.array([3.0 / np.cos(tilt)])
    scan = take_scan(ranges, np.zeros(1), turn, np.array([0.1, 0.0, 1.2]), 0.1, 12.0)
    assert np.allclose(scan.points, [[3.1, 0.0]])
    assert np.allclose(transform(PLACE, scan.origin[None])[0], compose(PLACE, [0.1, 0, 0])[:2])
