# SPDX-License-Identifier: Apache-2.0
"""Test the detector without a network, and the names of colours."""

from __future__ import annotations

import cv2
from humanoid_perception.colour_backend import ColourDetector
from humanoid_perception.colours import colour_name
import numpy as np
import pytest

GREY, RED, BLUE, GREEN = (128, 128, 128), (200, 30, 30), (40, 60, 200), (40, 160, 60)
FOCAL_PX = 200.0


def ground() -> tuple[np.ndarray, np.ndarray]:
    """Return a grey picture and a wall 2 m away."""
    return np.full((240, 320, 3), GREY, np.uint8), np.full((240, 320), 2.0, np.float32)


def put_box(picture, depth_m, box_px, colour, distance_m=1.5) -> None:
    """Draw a rectangle at a distance."""
    left, top, right, bottom = box_px
    picture[top:bottom, left:right] = colour
    depth_m[top:bottom, left:right] = distance_m


def test_shapes_have_names_colours_and_places():
    picture, depth_m = ground()
    put_box(picture, depth_m, (20, 100, 50, 130), BLUE)
    put_box(picture, depth_m, (80, 80, 100, 130), GREEN)
    cv2.circle(picture, (160, 120), 15, RED, -1)
    put_box(picture, depth_m, (220, 110, 260, 130), RED)
    found = ColourDetector().detect(picture, depth_m, FOCAL_PX)
    assert {(each.colour, each.class_id) for each in found} == {
        ('blue', 'cube'), ('green', 'bottle'), ('red', 'ball'), ('red', 'box'),
    }  # fmt: skip
    ball = next(each for each in found if each.class_id == 'ball')
    assert ball.box_px == pytest.approx((145, 105, 176, 136), abs=1.5)
    assert all(0.4 <= each.score <= 1.0 for each in found)
    assert not any(each.is_cut for each in found)


def test_things_of_one_colour_are_told_apart_by_depth():
    picture, depth_m = ground()
    put_box(picture, depth_m, (100, 100, 130, 130), RED, 1.2)
    put_box(picture, depth_m, (130, 100, 160, 130), RED, 1.5)
    assert len(ColourDetector().detect(picture, depth_m, FOCAL_PX)) == 2


def test_what_is_as_large_as_furniture_is_left_out():
    picture, depth_m = ground()
    put_box(picture, depth_m, (20, 100, 100, 150), RED, 1.9)
    assert ColourDetector().detect(picture, depth_m, FOCAL_PX) == []
    assert len(ColourDetector().detect(picture, None, FOCAL_PX)) == 1


def test_nothing_is_found_on_plain_ground():
    assert ColourDetector().detect(*ground(), FOCAL_PX) == []


def test_what_the_border_cuts_is_flagged():
    picture, depth_m = ground()
    put_box(picture, depth_m, (0, 100, 30, 130), BLUE)
    (found,) = ColourDetector().detect(picture, depth_m, FOCAL_PX)
    assert found.is_cut


def test_depth_without_measurements_does_not_hide_things():
    picture, depth_m = ground()
    put_box(picture, depth_m, (100, 100, 130, 130), BLUE, np.nan)
    (found,) = ColourDetector().detect(picture, depth_m, FOCAL_PX)
    assert found.class_id == 'cube'


@pytest.mark.parametrize(
    ('rgb', 'name'),
    [
        ((200, 30, 30), 'red'), ((90, 12, 10), 'red'), ((40, 60, 200), 'blue'),
        ((40, 160, 60), 'green'), ((240, 220, 40), 'yellow'), ((240, 130, 30), 'orange'),
        ((130, 50, 160), 'purple'), ((240, 140, 170), 'pink'), ((115, 70, 40), 'brown'),
        ((240, 240, 240), 'white'), ((128, 128, 128), 'grey'), ((20, 20, 20), 'black'),
    ],
)  # fmt: skip
def test_colours_have_their_usual_names(rgb, name):
    picture = np.full((40, 40, 3), rgb, np.uint8)
    assert colour_name(picture, (5.0, 5.0, 35.0, 35.0)) == (name, pytest.approx(1.0))


def test_a_label_does_not_hide_the_colour():
    picture = np.full((40, 40, 3), RED, np.uint8)
    picture[12:26, :] = 235
    name, share = colour_name(picture, (5.0, 5.0, 35.0, 35.0))
    assert name == 'red'
    assert 0.25 < share < 0.7


def test_a_box_that_is_too_small_has_no_colour():
    picture = np.full((40, 40, 3), RED, np.uint8)
    assert colour_name(picture, (5.0, 5.0, 6.0, 6.0)) == ('', 0.0)
