# SPDX-License-Identifier: Apache-2.0
"""Scenes, and the files that describe them."""

from __future__ import annotations

import math
from pathlib import Path

from humanoid_common.errors import UserError
from humanoid_simulation.files import installed_scenes
from humanoid_simulation.model import Placement
from humanoid_simulation.scene import load_scene, Scene, Thing
from humanoid_simulation.scene.terrain import Plates, plates_of, Ramp, ramp_of
import mujoco
import numpy as np
import pytest


@pytest.mark.parametrize('name', ['flat', 'room', 'uneven', 'push_test', 'apartment'])
def test_the_robot_stands_in_every_installed_scene(make_backend, name: str) -> None:
    """Nothing is in its way where it begins, and nothing bursts apart."""
    assert name in installed_scenes()
    backend = make_backend(scene=load_scene(name))
    for _ in range(100):
        backend.step({})
    touching = {c.body1 for c in backend.contacts() if c.body2.endswith('_foot')}
    assert touching == {'floor'}
    assert backend.ground_truth().position_m[2] > 0.68
    assert np.abs(backend.snapshot().qvel).max() < 0.5


def height_at(backend, x_m: float, y_m: float) -> float:
    """Return the height of the ground, found by a ray from above."""
    geom = np.zeros(1, dtype=np.int32)
    above, down = np.array([x_m, y_m, 3.0]), np.array([0.0, 0.0, -1.0])
    model, data = backend.model, backend._data
    return 3.0 - mujoco.mj_ray(model, data, above, down, None, 1, -1, geom, None)


def test_a_ramp_leads_up_and_down_again(make_backend) -> None:
    """Its surface has the slope that was asked for, without a step anywhere."""
    ramp = Ramp('ramp', (1.0, 0.5), math.pi / 2, math.radians(5.0), 1.5, 1.0, 1.0)
    backend = make_backend(scene=Scene('ramp', things=tuple(ramp_of(ramp))))
    slope = math.tan(math.radians(5.0))
    for along, height in [
        (0.01, 0.01 * slope),
        (0.75, 0.75 * slope),
        (1.49, 1.49 * slope),
        (2.0, 1.5 * slope),
        (2.51, 1.49 * slope),
        (3.99, 0.01 * slope),
    ]:
        assert height_at(backend, 1.0, 0.5 + along) == pytest.approx(height, abs=1e-6)


def test_plates_are_random_but_the_same_for_a_seed() -> None:
    """Heights are within the bounds, differ, and are repeated for the same seed."""

    def heights(seed: int) -> list[float]:
        plates = Plates('p', seed, (0.0, 0.0), (1.5, 0.6), (0.3, 0.3), 0.02)
        return [thing.position_m[2] + thing.size_m[2] / 2 for thing in plates_of(plates)]

    assert len(heights(1)) == 10
    assert heights(1) == heights(1) != heights(2)
    assert 0.0 < min(heights(1)) < max(heights(1)) <= 0.02
    assert len(set(heights(1))) == 10


def test_a_cover_leaves_places_free() -> None:
    """Only about that part of the places has a plate."""
    plates = Plates('p', 0, (0.0, 0.0), (6.0, 6.0), (0.3, 0.3), 0.02, 0.3)
    assert 80 < len(list(plates_of(plates))) < 160


def test_a_thing_is_as_big_and_heavy_as_the_file_says(make_backend, tmp_path: Path) -> None:
    """A scene file by its path: sizes, mass, place, turn and friction arrive in the world."""
    file = tmp_path / 'mine.yaml'
    file.write_text(
        'floor: {friction: 0.7}\n'
        'things:\n'
        '  - {name: crate, shape: box, size: [0.2, 0.4, 0.6], position: [1, 2, 0.3],\n'
        '     turn_deg: [0, 0, 90], mass: 3, friction: 0.4, colour: [1, 0, 0]}\n'
        '  - {name: post, shape: cylinder, size: [0.1, 1.0], position: [2, 2, 0.5]}\n'
    )
    model = make_backend(scene=load_scene(str(file))).model
    crate, post = model.geom('crate'), model.geom('post')
    assert tuple(crate.size) == pytest.approx((0.1, 0.2, 0.3))
    assert tuple(post.size[:2]) == pytest.approx((0.1, 0.5))
    assert model.body('crate').mass[0] == pytest.approx(3.0)
    assert tuple(model.body('crate').quat) == pytest.approx((math.sqrt(0.5), 0, 0, math.sqrt(0.5)))
    assert (model.geom('floor').friction[0], crate.friction[0]) == (0.7, 0.4)
    assert model.body('post').jntnum[0] == 0


def test_the_friction_of_the_floor_decides(make_backend) -> None:
    """A push that a rough floor withstands makes the robot slip on a smooth one."""
    from humanoid_simulation.scene import Floor

    moved = {}
    for friction in (0.05, 1.0):
        backend = make_backend(scene=Scene(floor=Floor(friction)))
        backend.apply_wrench('base_link', (0.0, 60.0, 0.0), duration_s=0.5)
        for _ in range(50):
            backend.step({})
        moved[friction] = abs(backend._data.body('robot/l_sole').xpos[1] - 0.085)
    assert moved[0.05] > 0.03 > 0.005 > moved[1.0]


@pytest.mark.parametrize(
    ('text', 'sentence'),
    [
        (
            'thing: []',
            "mine.yaml, line 1: the file has an unknown key 'thing'. Did you mean 'things'",
        ),
        ('floor: 3', 'mine.yaml, line 1: floor must be a mapping'),
        ('floor: {friction: nan}', None),
        ('floor: {friction: .nan}', 'mine.yaml, line 1: floor.friction must be a finite number'),
        ('floor: {friction: -1}', 'cannot have a friction of -1'),
        ('floor: {tile: 0}', 'tiles of 0 m'),
        ('things: {}', 'mine.yaml, line 1: things must be a list'),
        ('things: [{name: a}]', "mine.yaml, line 1: things[0] lacks the required key 'shape'"),
        (
            'things: [{name: a, shape: bal, size: [1], position: [0, 0, 0]}]',
            'mine.yaml, line 1: things[0].shape must be one of box, sphere, cylinder',
        ),
        (
            'things: [{name: a, shape: box, size: [1], position: [0, 0, 0]}]',
            'mine.yaml, line 1: things[0].size must be a list of 3 finite numbers, but is [1]',
        ),
        ('things: [{name: a, shape: sphere, size: [0], position: [0, 0, 0]}]', 'above zero'),
        ('things: [{name: floor, shape: sphere, size: [1], position: [0, 0, 0]}]', "'floor'"),
        ('things: [{name: world, shape: sphere, size: [1], position: [0, 0, 0]}]', "'world'"),
        ('things: [{nam: a}]', "things[0] has an unknown key 'nam'. Did you mean 'name'"),
        ('ramps: [{name: r, start: [0, 0], slope_deg: 60, length: 1, width: 1}]', '60 degrees'),
        ('ramps: [{name: r, start: [0, 0], slope_deg: 5, length: 0, width: 1}]', 'above zero'),
        (
            'plates: [{name: p, from: [0, 0], to: [-1, 1], edge: [0.1, 0.1], height: 0.02}]',
            'the larger coordinates',
        ),
        (
            'plates: [{name: p, from: [0, 0], to: [1, 1], edge: [1.0e-320, 0.1], height: 0.02}]',
            'room for 1 to 2000 plates',
        ),
        ('plates: [{name: p, seed: -1}]', 'seed must be a whole number of at least 0'),
        ('a: [', 'is not a valid YAML file'),
        ('- 1', 'must be a mapping of names to values'),
    ],
)
def test_mistakes_in_a_scene_file(tmp_path: Path, text: str, sentence: str | None) -> None:
    """Each becomes a sentence with the file and the key, and a hint where there is one."""
    file = tmp_path / 'mine.yaml'
    file.write_text(text)
    with pytest.raises(UserError) as caught:
        load_scene(str(file))
    assert (sentence or 'must be a finite number') in str(caught.value)


def test_a_scene_that_is_not_there(tmp_path: Path) -> None:
    """A name is compared with those that there are; a path is named as it is."""
    with pytest.raises(UserError, match="no scene 'rom'. Did you mean 'room'"):
        load_scene('rom')
    with pytest.raises(UserError, match=r'none.yaml cannot be read: No such file'):
        load_scene(str(tmp_path / 'none.yaml'))


def test_names_must_differ() -> None:
    """Two things of one name could not be told apart."""
    ball = Thing('ball', 'sphere', (0.1,))
    with pytest.raises(UserError, match="an object 'ball'"):
        Scene('two', things=(ball, ball))


@pytest.mark.parametrize('robot', ['', 'ball'])
def test_robots_and_things_must_differ(make_backend, robot: str) -> None:
    """A thing that is called like a robot would be mistaken for it."""
    name = robot or 'robot'
    scene = Scene('one', things=(Thing(name, 'sphere', (0.1,), mass_kg=1.0),))
    with pytest.raises(
        UserError, match=f"an object named '{name}', which is also the name of a robot"
    ):
        make_backend(scene=scene, placements=[Placement(robot)])
