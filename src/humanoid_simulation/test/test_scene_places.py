# SPDX-License-Identifier: Apache-2.0
"""The file of the named places of a scene."""

from __future__ import annotations

from pathlib import Path

from humanoid_simulation.scene import load_scene
from humanoid_simulation.scene_places import main
import pytest
import yaml


def test_surfaces_and_rooms_are_those_of_the_scene(tmp_path: Path) -> None:
    """To the centimetre."""
    path = tmp_path / 'places.yaml'
    assert main(['apartment', '--output', str(path)]) == 0
    table = yaml.safe_load(path.read_text())
    scene = load_scene('apartment')
    assert [each['name'] for each in table['rooms']] == [room.name for room in scene.rooms]
    for entry, surface in zip(table['surfaces'], scene.surfaces, strict=True):
        assert entry['name'] == surface.name
        assert entry['height'] == pytest.approx(surface.height_m, abs=0.005001)
        for corner, truth in zip(entry['outline'], surface.outline_m, strict=True):
            assert corner == pytest.approx(truth, abs=0.005001)


def test_a_scene_that_is_not_there_is_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """With what was meant, and no file is left."""
    path = tmp_path / 'places.yaml'
    assert main(['apartmant', '--output', str(path)]) == 1
    assert 'apartment' in capsys.readouterr().err
    assert not path.exists()


def test_a_file_that_cannot_be_written_is_a_sentence(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """And no part of it is left."""
    path = tmp_path / 'none' / 'places.yaml'
    assert main(['apartment', '--output', str(path)]) == 1
    assert capsys.readouterr().err == f'{path} cannot be written: No such file or directory.\n'


def test_bins_are_containers_and_fixtures_are_named(tmp_path: Path) -> None:
    """What stands on a surface for good, with its outline and height; nothing that can move."""
    path = tmp_path / 'places.yaml'
    assert main(['apartment', '--output', str(path)]) == 0
    surfaces = {each['name']: each for each in yaml.safe_load(path.read_text())['surfaces']}
    assert [name for name, each in surfaces.items() if 'container' in each] == ['kitchen_bin']
    counts = {name: len(each.get('fixtures', [])) for name, each in surfaces.items()}
    assert {name: count for name, count in counts.items() if count} == {
        'kitchen_counter': 2,  # sink and hob
        'tv_cabinet': 1,
        'nightstand': 1,
    }
    (television,) = surfaces['tv_cabinet']['fixtures']
    assert television['height'] == 0.72
    xs, ys = zip(*television['outline'])
    assert (max(xs) - min(xs), max(ys) - min(ys)) == pytest.approx((0.2, 1.1))
