# SPDX-License-Identifier: Apache-2.0
"""The file of a home: what it says, and what it may not."""

from __future__ import annotations

import math
from pathlib import Path

from humanoid_common.errors import UserError
from humanoid_simulation.scene import load_scene, Scene
from humanoid_simulation.scene.occupancy import FREE, occupancy_of
from humanoid_simulation.scene.walls import NARROWEST_DOOR_M, Wall
import pytest

ROBOT_RADIUS_M = 0.25
REACH_M = 0.75
HOME = """\
rooms:
  - {name: den, outline: [[-2, -2], [2, -2], [2, 2], [-2, 2]]}
furniture:
  - {name: table, kind: table, at: [1.0, 0.5], facing_deg: 90, size: [0.6, 1.0, 0.7]}
objects:
  - {name: mug, class: mug, colour: red, stands_on: table, at: [0.2, 0.3]}
places:
  - {name: table, stand: [0.0, 0.5], surface: table}
"""


@pytest.fixture(scope='module')
def apartment() -> Scene:
    """Return the apartment."""
    return load_scene('apartment')


def read(folder: Path, text: str) -> Scene:
    """Read a file."""
    file = folder / 'mine.yaml'
    file.write_text(text)
    return load_scene(str(file))


def test_the_apartment_has_rooms_doors_people_and_things(apartment: Scene) -> None:
    """Four rooms and a corridor; several classes in several colours; a red and a blue mug."""
    assert {room.name for room in apartment.rooms} == {
        'kitchen', 'living_room', 'bedroom', 'hall', 'corridor',
    }  # fmt: skip
    objects = {thing.name: thing for thing in apartment.objects}
    assert {'mug', 'bottle', 'can', 'ball', 'box', 'apple', 'book', 'bowl'} <= {
        thing.kind for thing in objects.values()
    }
    assert len({thing.colour for thing in objects.values()}) >= 6
    assert objects['red_mug'].kind == objects['blue_mug'].kind == 'mug'
    assert sum(thing.kind == 'person' for thing in apartment.things) == 2


def test_a_robot_can_stand_at_each_place_and_reach_its_surface(apartment: Scene) -> None:
    """Nothing solid is within its radius; the surface is ahead, in reach, at a height for it."""
    grid = occupancy_of(apartment, resolution_m=0.025)
    for place in apartment.places:
        assert apartment.room_at(place.x_m, place.y_m).name == place.room
        for turn in range(16):
            angle = math.tau * turn / 16
            x_m = place.x_m + ROBOT_RADIUS_M * math.cos(angle)
            y_m = place.y_m + ROBOT_RADIUS_M * math.sin(angle)
            assert grid.at(x_m, y_m) == FREE, place
        if place.surface is not None:
            assert 0.44 <= place.surface.height_m <= 0.81, place
            ahead = [
                place.surface.contains(
                    place.x_m + step * math.cos(place.yaw_rad),
                    place.y_m + step * math.sin(place.yaw_rad),
                )
                for step in (0.3, 0.4, 0.5, 0.6, REACH_M)
            ]
            assert any(ahead), place


def test_every_room_is_reached_from_the_start(apartment: Scene) -> None:
    """A map-maker that begins where the robot does comes to all named places."""
    grid = occupancy_of(apartment)
    assert all(grid.at(place.x_m, place.y_m) == FREE for place in apartment.places)
    assert {place.room for place in apartment.places} == {room.name for room in apartment.rooms}


def test_things_rest_on_what_the_file_names(tmp_path: Path) -> None:
    """Points on a surface count from its middle, x to the front of what has it."""
    scene = read(tmp_path, HOME)
    mug = scene.thing('mug')
    assert mug.position_m[:2] == pytest.approx((1.0 - 0.3, 0.5 + 0.2))
    assert mug.position_m[2] == pytest.approx(0.7 + 0.05, abs=0.002)
    assert (mug.kind, mug.colour, mug.box_m) == ('mug', 'red', (0.08, 0.08, 0.1))
    place = scene.place('table')
    assert (place.room, place.yaw_rad) == ('den', 0.0)
    assert place.surface.height_m == pytest.approx(0.7)
    assert place.surface.contains(1.4, 0.7) and not place.surface.contains(1.0, 0.9)
    assert scene.room_at(0.0, 0.0).name == 'den' and scene.room_at(3.0, 0.0) is None


def test_names_that_are_not_there_get_a_hint(apartment: Scene) -> None:
    """Whoever asks for a place, room, thing or surface by a wrong name learns the right one."""
    for ask, wrong, right in (
        (apartment.place, 'kitchen_tabel', 'kitchen_table'),
        (apartment.room, 'bedrom', 'bedroom'),
        (apartment.thing, 'red_mugg', 'red_mug'),
        (apartment.surface, 'sidebord', 'sideboard'),
    ):
        with pytest.raises(UserError, match=f"Did you mean '{right}'"):
            ask(wrong)


@pytest.mark.parametrize(
    ('old', 'new', 'sentence'),
    [
        ('kind: table', 'kind: tabel', 'line 4: furniture[0].kind must be one of'),
        ('kind: table', 'kind: tabel', "Did you mean 'table'"),
        ('class: mug', 'clas: mug', "line 6: objects[0] has an unknown key 'clas'"),
        ('colour: red', 'colour: rad', "but is 'rad'. Did you mean 'red'"),
        ('colour: red', 'colour: [1, 0, 2]', 'line 6: objects[0].colour must have components'),
        ('at: [0.2, 0.3]', 'at: [0.4, 0.3]', "line 6: 'mug' would not stand on 'table'"),
        ('stands_on: table', 'stands_on: tabel', "no surface 'tabel'. Did you mean 'table'"),
        ('surface: table', 'surface: bed', "line 8: there is no surface 'bed'"),
        ('stand: [0.0, 0.5]', 'stand: [5, 0]', "line 8: place 'table' is not in any room"),
        ('name: mug', 'name: table', "line 6: the name 'table' is already used on line 4"),
        ('[[-2, -2], [2, -2], [2, 2], [-2, 2]]', '[[0, 0], [1, 0]]', 'line 2: rooms[0].outline'),
        ('[[-2, -2], [2, -2], [2, 2], [-2, 2]]', '[[0, 0], [1, 0], [2, 0]]', 'on one line'),
        ('facing_deg: 90, size', 'at: [0, 0], size', "duplicate key 'at', also on line 4"),
        ('size: [0.6, 1.0, 0.7]', 'size: [0.6, 0, 0.7]', 'line 4: '),
    ],
)
def test_mistakes_in_a_home(tmp_path: Path, old: str, new: str, sentence: str) -> None:
    """Each is told with the file, the line and the key."""
    assert old in HOME
    with pytest.raises(UserError) as caught:
        read(tmp_path, HOME.replace(old, new))
    assert 'mine.yaml' in str(caught.value) and sentence in str(caught.value)


def test_two_rooms_or_places_of_one_name(tmp_path: Path) -> None:
    """They could not be told apart."""
    with pytest.raises(UserError, match="two places named 'table'"):
        read(tmp_path, HOME + '  - {name: table, stand: [0, 0]}\n')


@pytest.mark.parametrize(
    ('doors', 'sentence'),
    [
        ('[{at: 2, width: 0.8}]', 'needs 0.9 m or more'),
        ('[{at: 0.2, width: 1}]', 'no room for the door at 0.2 m'),
        ('[{at: 2, width: 1}, {at: 2.5, width: 1}]', 'no room for the door at 2.5 m'),
    ],
)
def test_doors_must_fit(tmp_path: Path, doors: str, sentence: str) -> None:
    """Into the wall, beside each other, and the robot through them."""
    with pytest.raises(UserError) as caught:
        read(tmp_path, f'walls:\n  - {{name: w, from: [0, 0], to: [4, 0], doors: {doors}}}\n')
    assert 'mine.yaml, line 2:' in str(caught.value) and sentence in str(caught.value)


def test_a_door_is_as_wide_as_the_file_says() -> None:
    """The solid pieces of a wall leave it open, and close it above."""
    from humanoid_simulation.scene.walls import Door

    wall = Wall('w', (0.0, 0.0), (4.0, 0.0), doors=(Door(2.0, 1.0),))
    pieces = list(wall.pieces())
    low = [piece for piece in pieces if piece[2] == 0.0]
    assert [(round(a, 3), round(b, 3)) for a, b, _, _ in low] == [(-0.05, 1.5), (2.5, 4.05)]
    assert (1.5, 2.5, 2.0, wall.height_m) in pieces
    assert NARROWEST_DOOR_M >= 0.9


def test_the_scene_is_read_without_ros_and_without_mujoco() -> None:
    """Who only wants to know what is where needs neither."""
    import subprocess
    import sys

    script = (
        'import sys; from humanoid_simulation.scene import load_scene; '
        "load_scene('apartment'); "
        "print([name for name in ('rclpy', 'mujoco') if name in sys.modules])"
    )
    done = subprocess.run(
        [sys.executable, '-c', script], capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == '[]'
