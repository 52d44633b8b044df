# SPDX-License-Identifier: Apache-2.0
"""Where the robot stands to reach a place."""

from __future__ import annotations

import math

from humanoid_perception.places import Places, Room, Surface
from llm_planner.standing import Pose, stands_at_object, stands_at_surface, stands_in_room
import pytest

KITCHEN = Room('kitchen', ((0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0)))
COUNTER = Surface('counter', ((0.2, 2.5), (3.8, 2.5), (3.8, 3.0), (0.2, 3.0)), 0.8)
TABLE = Surface('table', ((1.6, 1.0), (2.4, 1.0), (2.4, 1.6), (1.6, 1.6)), 0.7)
PLACES = Places('map', (COUNTER, TABLE), (KITCHEN,))


def facing_rad(pose: Pose, point: tuple[float, float]) -> float:
    """Return by how much a pose faces beside a point."""
    bearing = math.atan2(point[1] - pose[1], point[0] - pose[0])
    return abs(math.remainder(bearing - pose[2], math.tau))


def test_before_a_counter_at_a_wall() -> None:
    """Only the side in the room is left; near to what is wanted comes first."""
    poses = stands_at_surface(COUNTER, PLACES, (1.0, 2.8))
    assert poses
    for x, y, yaw in poses:
        assert y == pytest.approx(2.0) and yaw == pytest.approx(math.pi / 2)
        assert 0.2 <= x <= 3.8
    assert poses[0][0] == pytest.approx(1.0)


def test_around_a_table() -> None:
    """All sides serve, but not those where other furniture is too near."""
    poses = stands_at_surface(TABLE, PLACES, (2.4, 1.3))
    assert poses[0][:2] == pytest.approx((2.9, 1.3)) and facing_rad(poses[0], (2.0, 1.3)) < 0.01
    assert all(y < 2.1 for _, y, _ in poses)


def test_in_a_room() -> None:
    """The free floor nearest to the middle, which the table takes, facing it."""
    poses = stands_in_room(KITCHEN, PLACES, 3)
    assert len(poses) == 3
    for pose in poses:
        assert 0.4 < math.dist(pose[:2], (2.0, 1.3)) < 1.3
        assert facing_rad(pose, (2.0, 1.5)) < 0.01


def test_beside_an_object_on_the_floor() -> None:
    """Facing it from a distance, within the room."""
    poses = stands_at_object((0.3, 0.3), PLACES)
    assert poses
    for pose in poses:
        assert math.dist(pose[:2], (0.3, 0.3)) == pytest.approx(0.6)
        assert facing_rad(pose, (0.3, 0.3)) < 0.01 and pose[0] > 0.0 and pose[1] > 0.0


def test_there_may_be_no_place() -> None:
    """A room full of furniture has none."""
    full = Places('map', (Surface('bed', KITCHEN.outline_m, 0.5),), (KITCHEN,))
    assert stands_in_room(KITCHEN, full) == []
    assert len(stands_at_object((9.0, 9.0), full)) == 12
