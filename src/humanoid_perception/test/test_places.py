# SPDX-License-Identifier: Apache-2.0
"""Test named places: what stands on what, and in which room."""

from __future__ import annotations

from pathlib import Path

from humanoid_common.errors import UserError
from humanoid_perception.places import Places, Room, Surface
from humanoid_perception.places_file import load_places
import numpy as np
import pytest

SQUARE = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))
PLACES = Places(
    'map',
    (Surface('table', SQUARE, 0.7), Surface('board', SQUARE, 0.3), Surface('floor', SQUARE, 0.0)),
    (Room('den', ((-2.0, -2.0), (2.0, -2.0), (2.0, 2.0), (-2.0, 2.0))),),
)
APARTMENT = Path(__file__).parents[1] / 'config' / 'places_apartment.yaml'


@pytest.mark.parametrize(
    ('at', 'name'),
    [
        ((0.5, 0.5, 0.7), 'table'),
        ((0.5, 0.5, 0.75), 'table'),
        ((0.5, 0.5, 0.66), 'table'),
        ((1.06, 0.5, 0.7), 'table'),
        ((1.06, 1.06, 0.7), ''),
        ((0.5, 0.5, 0.9), ''),
        ((0.5, 0.5, 0.34), 'board'),
        ((3.0, 0.5, 0.7), ''),
        ((float('nan'), 0.5, 0.7), ''),
    ],
)
def test_a_thing_stands_on_the_surface_below_it(at: tuple[float, float, float], name: str) -> None:
    """A little beside or above it is on it, too; far above is not."""
    assert PLACES.surface_at(*at) == name


@pytest.mark.parametrize(
    ('at', 'sigma_m', 'name'),
    [
        ((1.15, 0.5, 0.7), 0.0, ''),
        ((1.15, 0.5, 0.7), 0.05, 'table'),
        ((0.5, 0.5, 0.85), 0.05, 'table'),
        ((0.5, 0.5, 0.48), 0.1, 'board'),
        ((0.5, 0.5, 0.52), 0.1, 'table'),
        ((1.5, 0.5, 0.7), 5.0, ''),
    ],
)
def test_what_is_less_sure_may_be_farther_from_its_surface(
    at: tuple[float, float, float], sigma_m: float, name: str
) -> None:
    """The nearest in height is meant; beyond a limit it stands on none, however unsure it is."""
    assert PLACES.surface_at(*at, sigma_m) == name


def test_rooms_are_where_they_are() -> None:
    """Outside of all there is none."""
    assert PLACES.room_at(0.0, 0.0) == 'den'
    assert PLACES.room_at(2.5, 0.0) == ''
    assert Places().room_at(0.0, 0.0) == ''


def test_a_point_is_in_a_concave_outline_where_it_seems_to_be() -> None:
    """An L has a corner that is not part of it."""
    corner = ((0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0))
    places = Places('map', (), (Room('l', corner),))
    random = np.random.default_rng(1)
    for x, y in random.uniform(-0.5, 2.5, (500, 2)):
        inside = 0.0 < x < 2.0 and 0.0 < y < 2.0 and not (x > 1.0 and y > 1.0)
        assert (places.room_at(x, y) == 'l') == inside


def test_the_apartment_has_what_people_name() -> None:
    """Where its things are at home."""
    places = load_places(APARTMENT)
    assert places.frame == 'map'
    assert {'kitchen_table', 'kitchen_counter', 'sideboard', 'kitchen', 'hall'} <= set(
        places.names
    )
    assert places.surface_at(-0.15, 2.1, 0.71) == 'kitchen_table'
    assert places.room_at(-0.15, 2.1) == 'kitchen'


@pytest.mark.parametrize(
    ('text', 'part'),
    [
        ('surfaces: {a: 1}', 'list'),
        ('surfaces: [{name: a, outline: [[0, 0], [1, 0], [1, 1]]}]', "'height'"),
        ('surfaces: [{name: a, hight: 1}]', "Did you mean 'height'?"),
        (
            'surfaces: [{name: a, height: 1, outline: [[0, 0], [1, 0], [1, 1]], container: 1}]',
            'true or false',
        ),
        (
            'surfaces: [{name: a, height: 1, outline: [[0, 0], [1, 0], [1, 1]], '
            'fixtures: [{outline: [[0, 0], [1, 0]], height: 1}]}]',
            'surfaces[0].fixtures[0].outline must be three or more corners',
        ),
        (
            'surfaces: [{name: a, height: 1, outline: [[0, 0], [1, 0], [1, 1]], '
            'fixtures: [{outline: [[0, 0], [1, 0], [1, 1]]}]}]',
            "surfaces[0].fixtures[0] lacks the required key 'height'",
        ),
        ('rooms: [{name: a, outline: [[0, 0], [1, 0]]}]', 'three or more corners'),
        ('rooms: [{name: a, outline: [[0, 0], [1, 0], [1, .nan]]}]', 'corners [x, y] in metres'),
        ('rooms: [{name: a, outline: [[0, 0], [1, 0], [1, "1"]]}]', 'corners [x, y] in metres'),
        (
            'surfaces:\n- {name: a, outline: [[0, 0], [1, 0], [1, 1]],\n   height: "1"}',
            "line 3: surfaces[0].height must be a finite number, but is '1'.",
        ),
        ('rooms: [{name: a}]', "rooms[0] lacks the required key 'outline'"),
        ('rooms: [{name: 3, outline: [[0, 0], [1, 0], [1, 1]]}]', 'string'),
        ('room: []', "Did you mean 'rooms'?"),
        ('frame: 3', 'frame'),
        ('- 3', 'must be a mapping of names to values'),
        ('{', 'is not a valid YAML file (line 1'),
        (
            'rooms: [{name: a, outline: [[0, 0], [1, 0], [1, 1]]}, '
            '{name: a, outline: [[0, 0], [1, 0], [1, 1]]}]',
            "two places are named 'a'",
        ),
    ],
)
def test_a_mistake_in_the_file_is_named(tmp_path: Path, text: str, part: str) -> None:
    """With the file, and what was meant."""
    path = tmp_path / 'places.yaml'
    path.write_text(text)
    with pytest.raises(UserError, match='places.yaml') as error:
        load_places(path)
    assert part in str(error.value)


def test_lists_may_be_empty(tmp_path: Path) -> None:
    """Also without brackets."""
    path = tmp_path / 'places.yaml'
    path.write_text('surfaces:\nrooms: []\n')
    assert load_places(path) == Places()


def test_an_empty_file_of_places_is_no_table(tmp_path: Path) -> None:
    """Nothing was saved: that is said."""
    path = tmp_path / 'places.yaml'
    path.write_text('')
    with pytest.raises(UserError, match='the file must be a mapping .*, but is empty'):
        load_places(path)


def test_a_file_that_is_not_there_is_named(tmp_path: Path) -> None:
    """As a sentence."""
    with pytest.raises(UserError, match='cannot be read'):
        load_places(tmp_path / 'nothing.yaml')


def test_the_bin_of_the_apartment_is_a_container() -> None:
    """It alone: what is put elsewhere stays on top."""
    found = [each.name for each in load_places(APARTMENT).surfaces if each.is_container]
    assert found == ['kitchen_bin']


def test_the_television_stands_on_its_cabinet_for_good() -> None:
    """Where it is, and how high."""
    surfaces = {each.name: each for each in load_places(APARTMENT).surfaces}
    (television,) = surfaces['tv_cabinet'].fixtures
    assert television.distance_m((5.95, -3.1)) == 0.0
    assert television.distance_m((5.9, -2.3)) == pytest.approx(0.25, abs=0.02)
    assert television.height_m == pytest.approx(0.72)
