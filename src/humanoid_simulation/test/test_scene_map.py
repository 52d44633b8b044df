# SPDX-License-Identifier: Apache-2.0
"""The map of a scene, against rays in the world, and its files."""

from __future__ import annotations

import math
from pathlib import Path

from humanoid_simulation.backend import MujocoBackend
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.model.robot_spec import COLLISION_GROUP
from humanoid_simulation.scene import load_scene, Scene, Thing
from humanoid_simulation.scene.occupancy import (
    FREE,
    Layer,
    occupancy_of,
    OccupancyMap,
    OCCUPIED,
    UNKNOWN,
)
from humanoid_simulation.scene_map import main, write_map
import mujoco
import numpy as np
import pytest

SCANNER_M = 0.95
RAYS = 200


def without_objects(scene: Scene) -> Scene:
    """Return the scene with what is fixed alone."""
    fixed = tuple(thing for thing in scene.things if thing.is_fixed)
    return Scene(scene.name, scene.floor, fixed, scene.rooms, scene.places, scene.surfaces)


def hit_m(backend: MujocoBackend, start: np.ndarray, angle: float) -> float:
    """Return how far a level ray goes to what is seen, apart from the robot."""
    model, data = backend.model, backend.data
    geom = np.zeros(1, dtype=np.int32)
    ray = np.array([math.cos(angle), math.sin(angle), 0.0])
    groups = np.array([group < COLLISION_GROUP for group in range(6)], dtype=np.uint8)
    robot = backend.model.body('robot/base_link').id
    distance = mujoco.mj_ray(model, data, start, ray, groups, 1, robot, geom, None)
    assert distance > 0.0
    return float(distance)


def first_occupied_m(grid: OccupancyMap, start: np.ndarray, angle: float) -> float:
    """Return how far it is along a ray to the first cell that is occupied."""
    for step in np.arange(0.0, 12.0, 0.002):
        x_m, y_m = start[0] + step * math.cos(angle), start[1] + step * math.sin(angle)
        if grid.at(x_m, y_m) == OCCUPIED:
            return float(step)
    return math.inf


def test_the_map_agrees_with_rays_of_a_scanner(make_backend) -> None:
    """From random places in all rooms, the first occupied cell is where a ray ends."""
    scene = without_objects(load_scene('apartment'))
    backend = make_backend(scene=scene)
    # Aloft, so that no ray meets it.
    backend.data.qpos[2] = 50.0
    mujoco.mj_forward(backend.model, backend.data)
    grid = occupancy_of(scene, Layer(SCANNER_M, SCANNER_M))
    random = np.random.default_rng(3)
    near_m = 2.0 * grid.resolution_m
    close = 0
    for place in random.choice(np.array(scene.places, dtype=object), RAYS):
        start = np.array([place.x_m, place.y_m, SCANNER_M])
        angle = random.uniform(0.0, math.tau)
        drawn_m = first_occupied_m(grid, start, angle)
        # A cell that is partly occupied is occupied: a ray that grazes an edge ends at the one or
        # at the other side of it. So a beam as wide as two cells each way is compared.
        aside = near_m * np.array([-math.sin(angle), math.cos(angle), 0.0])
        shares = np.linspace(-1.0, 1.0, 13)
        real_m = [hit_m(backend, start + share * aside, angle) for share in shares]
        assert min(real_m) - near_m < drawn_m < max(real_m) + near_m, (place.name, angle, real_m)
        close += abs(drawn_m - hit_m(backend, start, angle)) < near_m
    assert close > 0.8 * RAYS


def test_furniture_is_in_the_map_by_default_and_not_at_the_height_of_a_scanner() -> None:
    """A table ends below the scanner: only the layer of heights has it."""
    scene = load_scene('apartment')
    x_m, y_m = scene.surface('coffee_table').centre_m
    assert occupancy_of(scene).at(x_m, y_m) == OCCUPIED
    assert occupancy_of(scene, Layer(SCANNER_M, SCANNER_M)).at(x_m, y_m) == FREE


def test_what_cannot_be_reached_is_unknown() -> None:
    """Outside of the walls, and inside of what is closed."""
    scene = load_scene('apartment')
    grid = occupancy_of(scene)
    assert grid.at(-2.0, 3.5) == UNKNOWN
    assert grid.at(100.0, 0.0) == UNKNOWN
    assert set(np.unique(grid.cells).tolist()) == {UNKNOWN, FREE, OCCUPIED}


@pytest.mark.parametrize('tilt_rad', [0.0, 0.4, math.pi / 2])
def test_sections_of_tilted_things_are_exact(tilt_rad: float) -> None:
    """A cell is occupied if and only if the section of a tilted board reaches into it."""
    board = Thing('board', 'box', (1.0, 0.5, 0.2), (2.0, 0.0, 0.5), (0.0, tilt_rad, 0.3))
    grid = occupancy_of(Scene('s', things=(board,)), Layer(0.5, 0.5), 0.02)
    turn = np.array([math.cos(0.3), math.sin(0.3)])
    half_m = min(0.5 / max(math.cos(tilt_rad), 1e-9), 0.1 / max(math.sin(tilt_rad), 1e-9))
    for side in (1.0, -1.0):
        inside = np.array([2.0, 0.0]) + side * (half_m - 0.03) * turn
        outside = np.array([2.0, 0.0]) + side * (half_m + 0.03) * turn
        assert grid.at(*inside) == OCCUPIED
        assert grid.at(*outside) == FREE


def test_the_files_are_what_map_servers_read(tmp_path: Path, capsys) -> None:
    """Three greys; the first row of the picture is that of the largest y; all keys are there."""
    assert main(['apartment', '--output', str(tmp_path / 'home')]) == 0
    assert 'home.yaml' in capsys.readouterr().out
    import yaml

    table = yaml.safe_load((tmp_path / 'home.yaml').read_text())
    assert table['mode'] == 'trinary' and table['resolution'] == 0.05 and table['negate'] == 0
    assert (table['occupied_thresh'], table['free_thresh']) == (0.65, 0.196)
    raw = (tmp_path / table['image']).read_bytes()
    kind, size, deepest, pixels = raw.split(b'\n', 3)
    columns, rows = map(int, size.split())
    assert (kind, deepest) == (b'P5', b'255')
    picture = np.frombuffer(pixels, np.uint8).reshape(rows, columns)
    assert set(np.unique(picture).tolist()) == {0, 205, 254}
    grid = occupancy_of(load_scene('apartment'), margin_m=0.5)
    assert table['origin'] == pytest.approx([*grid.origin_m, 0.0])
    assert np.array_equal(picture[::-1] == 0, grid.cells == OCCUPIED)
    assert np.array_equal(picture[::-1] == 254, grid.cells == FREE)


@pytest.mark.parametrize(
    ('arguments', 'sentence'),
    [
        (['apartmnt'], "Did you mean 'apartment'"),
        (['--from-height', '2', '--to-height', '1'], 'Give the lower height first'),
        (['--resolution', '0'], 'Give 0.005 to 1 m'),
        (['--start', '2.7', '2.0'], 'something solid is there'),
        (['--resolution', '0.005', '--margin', '100'], 'Give larger cells'),
        (['--output', 'no/such/folder/map'], 'cannot be written'),
        (['--margin', '-1'], 'A margin of -1 m is too small'),
        (['flat', '--margin', '0'], 'A margin of 0 m is too small'),
    ],
)
def test_what_cannot_be_drawn_is_a_sentence(
    tmp_path: Path, monkeypatch, capsys, arguments: list[str], sentence: str
) -> None:
    """On standard error, with status 1; no file is there, whole or half."""
    monkeypatch.chdir(tmp_path)
    assert main(arguments) == 1
    assert sentence in capsys.readouterr().err
    assert list(tmp_path.rglob('*')) == []


def test_an_old_map_outlives_a_failure(tmp_path: Path, monkeypatch) -> None:
    """Until the new files are complete, the old ones are there; nothing else is left."""
    grid = occupancy_of(load_scene('room'))
    write_map(grid, tmp_path / 'map')
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}

    def fail(self: Path, target: Path) -> None:
        raise OSError(28, 'No space left on device')

    monkeypatch.setattr(Path, 'replace', fail)
    with pytest.raises(SimulationError, match=r'map.pgm cannot be written: No space left'):
        write_map(occupancy_of(load_scene('apartment')), tmp_path / 'map')
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before
