# SPDX-License-Identifier: Apache-2.0
"""Check how things of all shapes are grasped, and where one stands for that."""

from __future__ import annotations

import math

from humanoid_description.expansion import humanoid_urdf
from humanoid_description.loading import load_robot
from humanoid_description.rotations import about_z
from humanoid_manipulation.grasps import Grasp, Graspable, grasps_of, Hand
from humanoid_manipulation.placing import free_spots
from humanoid_manipulation.stances import base_of, Bend, BENDS, grasp_reaches, stances_for
from humanoid_manipulation.surroundings import surface_boxes
from humanoid_manipulation.upper_body import UpperBody
from humanoid_perception.places import Places, Surface
from humanoid_perception.places_file import load_places, places_path
import numpy as np
import pytest

HAND = Hand()
BODY = UpperBody.of(load_robot(humanoid_urdf(hands=True), 'the humanoid'))
THINGS = {
    'mug': (0.08, 0.08, 0.10), 'bottle': (0.07, 0.07, 0.24), 'can': (0.066, 0.066, 0.12),
    'apple': (0.075, 0.075, 0.075), 'cube': (0.06, 0.06, 0.06), 'book': (0.14, 0.20, 0.03),
    'box': (0.16, 0.075, 0.08),
}  # fmt: skip


def thing(
    kind: str, at: tuple[float, float, float] = (0.0, 0.0, 0.0), yaw: float = 0.4
) -> Graspable:
    """Return a thing that stands at a point."""
    size = np.array(THINGS[kind])
    return Graspable(kind, np.array(at) + [0.0, 0.0, size[2] / 2.0], size, yaw)


@pytest.mark.parametrize('kind', THINGS)
def test_fingers_come_around_the_thing_and_touch_nothing_below(kind: str) -> None:
    """They open wider than it, and stay above what it stands on."""
    subject = thing(kind)
    found = list(grasps_of(subject))
    if kind == 'book':
        assert found == []
        return
    assert found
    for grasp in found:
        assert grasp.width_m + 0.01 < grasp.gap_m <= HAND.widest_m
        across = grasp.gripper.rotation[:, 1]
        extent = extent_along(subject, across)
        assert grasp.width_m >= extent - 1e-9
        middle = float((subject.position_m - grasp.gripper.position_m) @ across)
        assert middle == pytest.approx(0.0, abs=1e-9)
        ahead, up = -grasp.gripper.rotation[:, 2], grasp.gripper.rotation[:, 0]
        tip = grasp.gripper.position_m + HAND.tip_m * ahead
        assert tip[2] - abs(up[2]) * HAND.finger_m / 2.0 > 0.004


def extent_along(subject: Graspable, direction: np.ndarray) -> float:
    """Return how wide a thing is along a direction."""
    if subject.is_round:
        return float(min(subject.size_m[:2]))
    local = about_z(subject.yaw_rad).T @ direction
    return float(np.abs(local[:2]) @ subject.size_m[:2])


@pytest.mark.parametrize('kind', ['mug', 'box'])
def test_the_palm_does_not_touch_what_is_deep(kind: str) -> None:
    """It stays before the near side of the thing."""
    subject = thing(kind)
    for grasp in grasps_of(subject):
        if grasp.from_above:
            continue
        ahead = -grasp.gripper.rotation[:, 2]
        level = np.array([*ahead[:2], 0.0]) / np.hypot(*ahead[:2])
        edge = subject.position_m - 0.5 * extent_along(subject, level) * level
        edge[2] += 0.5 * subject.size_m[2]
        palm = grasp.gripper.position_m - HAND.palm_m * ahead
        assert float((edge - palm) @ ahead) > 0.004


def test_a_ball_is_held_by_its_middle_and_not_touched_by_the_palm() -> None:
    """However the hand is tilted: the corners of its box are empty, and it would roll away."""
    ball = thing('apple')
    tilted = [each for each in grasps_of(ball) if not each.from_above]
    assert len({round(each.gripper.rotation[2, 2], 3) for each in tilted}) == 3
    for grasp in tilted:
        beside = ball.position_m - grasp.gripper.position_m
        deep_m = float(beside @ -grasp.gripper.rotation[:, 2])
        assert HAND.palm_m + deep_m - 0.5 * ball.size_m[0] >= 0.01 - 1e-9
        assert 0.0 <= deep_m < 0.5 * HAND.tip_m


def test_a_round_thing_is_grasped_from_all_sides_and_a_box_from_four() -> None:
    """And both from above."""
    mug, cube = list(grasps_of(thing('mug'))), list(grasps_of(thing('cube')))
    assert len({heading(each) for each in mug if not each.from_above}) == 16
    assert len({heading(each) for each in cube if not each.from_above}) == 4
    assert any(each.from_above for each in mug) and any(each.from_above for each in cube)


def heading(grasp: Grasp) -> float:
    """Return where a hand comes from, seen from above (rad)."""
    z = grasp.gripper.rotation[:, 2]
    return round(math.atan2(z[1], z[0]), 6)


def test_a_mug_with_its_handle_is_as_wide_as_without() -> None:
    """The memory has seen both."""
    seen = Graspable('mug', np.array([0.0, 0.0, 0.05]), np.array([0.12, 0.08, 0.10]))
    assert {each.width_m for each in grasps_of(seen)} == {0.08}


@pytest.mark.parametrize('bend', BENDS)
def test_a_bent_body_is_lower_and_farther_back(bend: Bend) -> None:
    """The pelvis, while the feet stay."""
    upright = base_of(1.0, 2.0, 0.5, Bend())
    bent = base_of(1.0, 2.0, 0.5, bend)
    heading = np.array([math.cos(0.5), math.sin(0.5), 0.0])
    assert (bent.position_m - upright.position_m) @ heading <= 1e-12
    assert bent.rotation[:, 0] @ heading == pytest.approx(math.cos(bend.pitch_rad))


TABLE = Places(
    'map', (Surface('table', ((0.0, -0.6), (0.7, -0.6), (0.7, 0.6), (0.0, 0.6)), 0.70),)
)


@pytest.mark.parametrize(('kind', 'at'), [('mug', (0.2, 0.0)), ('bottle', (0.35, 0.1))])
def test_one_stands_beside_the_table_and_reaches(kind: str, at: tuple[float, float]) -> None:
    """Not in it; and the hand gets to the grasp with the body bent so."""
    subject = thing(kind, (*at, 0.70))
    stances = stances_for(BODY, list(grasps_of(subject)), subject.position_m, TABLE)
    assert stances
    for stance in stances:
        assert TABLE.surfaces[0].distance_m((stance.x_m, stance.y_m)) >= 0.20
        base = base_of(stance.x_m, stance.y_m, stance.yaw_rad, stance.bend)
        assert grasp_reaches(BODY, stance.side, stance.grasp, base) is not None
    assert [each.cost for each in stances] == sorted(each.cost for each in stances)


def test_one_hand_may_be_asked_for() -> None:
    """The other one holds something, say."""
    subject = thing('can', (0.2, 0.0, 0.70))
    grasps = list(grasps_of(subject))
    found = stances_for(BODY, grasps, subject.position_m, TABLE, sides=('right',))
    assert found and {each.side for each in found} == {'right'}


def test_what_is_in_the_middle_of_a_large_table_is_out_of_reach() -> None:
    """One does not climb onto it."""
    wide = Places(
        'map', (Surface('table', ((-1.5, -1.5), (1.5, -1.5), (1.5, 1.5), (-1.5, 1.5)), 0.7),)
    )
    subject = thing('can', (0.0, 0.0, 0.70))
    assert stances_for(BODY, list(grasps_of(subject)), subject.position_m, wide) == []


def test_in_the_apartment_one_stays_in_the_room() -> None:
    """A wall is between the kitchen table and the hall."""
    path = places_path('apartment')
    assert path is not None
    places = load_places(path)
    subject = thing('mug', (-0.15, 2.1, 0.70))
    stances = stances_for(BODY, list(grasps_of(subject)), subject.position_m, places)
    assert stances
    assert {places.room_at(each.x_m, each.y_m) for each in stances} == {'kitchen'}


def test_free_spots_are_on_the_surface_and_clear_of_things() -> None:
    """With room to the edge and to others; the nearest come first."""
    (surface,) = TABLE.surfaces
    others = [(0.2, 0.0, 0.05), (0.3, 0.3, 0.05)]
    spots = list(free_spots(surface, others, 0.04, (-0.3, 0.0)))
    assert len(spots) > 20
    for x, y in spots:
        assert 0.07 < x < 0.63 and -0.53 < y < 0.53
        assert all(math.dist((x, y), other[:2]) > 0.12 for other in others)
    away = [math.dist(spot, (-0.3, 0.0)) for spot in spots]
    assert away == sorted(away)
    assert list(free_spots(surface, [(0.35, 0.0, 2.0)], 0.04, (0.0, 0.0))) == []


def test_free_spots_are_clear_of_what_stands_there_for_good() -> None:
    """Beside the television, not in it, which is in the way of arms, too."""
    path = places_path('apartment')
    assert path is not None
    surfaces = {each.name: each for each in load_places(path).surfaces}
    cabinet = surfaces['tv_cabinet']
    (television,) = cabinet.fixtures
    spots = list(free_spots(cabinet, [], 0.04, (5.2, -3.0)))
    assert spots and all(television.distance_m(spot) > 0.08 for spot in spots)
    block, screen = surface_boxes(cabinet)
    assert screen.size_m == pytest.approx((1.1, 0.2, 0.72))
    assert screen.middle.position_m == pytest.approx([5.95, -3.1, 0.5 + 0.36])
    assert block.middle.position_m[2] == pytest.approx(0.25)
