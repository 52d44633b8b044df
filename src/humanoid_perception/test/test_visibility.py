# SPDX-License-Identifier: Apache-2.0
"""Test what a look says of a thing that was not detected in it."""

from __future__ import annotations

from dataclasses import replace

from humanoid_perception.memory_testing import around, Box, BoxWorld, TABLE, WALL
from humanoid_perception.visibility import Evidence, evidence_at
import numpy as np
import pytest

MUG = Box('mug', (0.0, 0.0, 0.75))
AT, SIZE = np.array(MUG.position), np.array(MUG.size)
ANGLES = np.linspace(-1.2, 1.2, 5)


@pytest.mark.parametrize('angle', ANGLES)
@pytest.mark.parametrize('radius', [0.9, 1.4, 2.2])
def test_an_empty_place_on_a_table_is_empty(radius: float, angle: float) -> None:
    """The table below does not count as the thing."""
    world = BoxWorld([TABLE, WALL])
    view = world.view(around(AT, radius, angle), AT)
    assert evidence_at(view, AT, SIZE) is Evidence.EMPTY


@pytest.mark.parametrize('angle', ANGLES)
@pytest.mark.parametrize('radius', [0.9, 1.4, 2.2])
@pytest.mark.parametrize('offset', [0.0, 0.04])
def test_a_thing_that_is_there_is_something(radius: float, angle: float, offset: float) -> None:
    """Also a few centimetres from where it is remembered."""
    world = BoxWorld([TABLE, WALL, MUG])
    view = world.view(around(AT, radius, angle), AT)
    assert evidence_at(view, AT + [0.0, offset, 0.0], SIZE, sigma_m=0.03) is Evidence.SOMETHING


def test_what_is_hidden_says_nothing() -> None:
    """By a wall, or by the robot's own hand."""
    screen = Box('screen', (0.7, 0.0, 1.0), (0.02, 1.0, 1.0), '', is_detectable=False)
    world = BoxWorld([TABLE, screen])
    view = world.view((1.6, 0.0, 1.2), AT)
    assert evidence_at(view, AT, SIZE) is Evidence.NONE


@pytest.mark.parametrize(
    'towards', [(0.0, 3.0, 0.7), (3.0, 0.0, 1.2), (0.0, 0.7, 0.75)], ids=['aside', 'away', 'cut']
)
def test_out_of_the_picture_says_nothing(towards: tuple[float, float, float]) -> None:
    """Nor does what the border of the picture cuts."""
    world = BoxWorld([TABLE, WALL])
    view = world.view((1.0, 0.0, 1.2), towards)
    assert evidence_at(view, AT, SIZE) is Evidence.NONE


def test_far_and_small_things_say_nothing() -> None:
    """A detector cannot be blamed for them."""
    world = BoxWorld([TABLE])
    view = world.view((3.8, 0.0, 1.2), AT)
    assert evidence_at(view, AT, SIZE, max_range_m=3.5) is Evidence.NONE
    assert evidence_at(view, AT, SIZE, max_range_m=9.0, min_size_px=20.0) is Evidence.NONE
    assert evidence_at(view, AT, SIZE, max_range_m=9.0, min_size_px=2.0) is Evidence.EMPTY


def test_without_depth_nothing_more_is_known() -> None:
    """It should be there, and that is all."""
    view = BoxWorld([]).view((1.2, 0.0, 1.2), AT, depth=False)
    assert evidence_at(view, AT, SIZE) is Evidence.UNKNOWN


@pytest.mark.parametrize('value', [np.nan, 0.0, -1.0])
def test_a_blind_depth_camera_says_nothing(value: float) -> None:
    """Zeros and NaN are no measurement of an empty place."""
    world = BoxWorld([TABLE])
    view = world.view((1.2, 0.0, 1.2), AT)
    blind = replace(view, depth_m=np.full_like(view.depth_m, value))
    assert evidence_at(blind, AT, SIZE) is Evidence.NONE


def test_nothing_at_all_behind_is_empty_too() -> None:
    """An infinite depth is one at which nothing is (REP 117)."""
    view = BoxWorld([]).view((1.2, 0.0, 1.2), AT)
    assert np.isposinf(view.depth_m).all()
    assert evidence_at(view, AT, SIZE) is Evidence.EMPTY


def test_a_depth_image_may_be_smaller_than_the_picture() -> None:
    """As those of many cameras are."""
    world = BoxWorld([TABLE, WALL, MUG])
    view = world.view((1.2, 0.0, 1.2), AT)
    assert view.depth_m is not None
    small = replace(view, depth_m=view.depth_m[::2, ::2])
    assert evidence_at(small, AT, SIZE) is Evidence.SOMETHING
