# SPDX-License-Identifier: Apache-2.0
"""The shells of the humanoid: closed surfaces, which are the committed ones."""

from __future__ import annotations

from pathlib import Path
import sys

import numpy as np
import pytest
import trimesh

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / 'meshes'))

from shells import FOLDER, mesh_of, Shell, SHELLS, STEP_M, stl_of  # noqa: E402

MOST_TRIANGLES = 3000
MOST_BYTES = 2_000_000


def test_committed_files_are_those_of_the_program() -> None:
    """Each file holds the shell of its name; a last digit may differ on another machine."""
    assert {path.name for path in FOLDER.iterdir()} == {f'{name}.stl' for name in SHELLS}
    for name, shell in SHELLS.items():
        committed = trimesh.load(FOLDER / f'{name}.stl', process=False)
        vertices, faces = mesh_of(shell)
        assert np.allclose(committed.triangles, vertices[faces], atol=1.5 * STEP_M), name


def test_files_are_small() -> None:
    """All files together take no more than 2 MB."""
    assert 0 < sum(path.stat().st_size for path in FOLDER.iterdir()) <= MOST_BYTES


@pytest.mark.parametrize('name', SHELLS)
def test_shell_is_closed(name: str) -> None:
    """A shell is watertight, its triangles face outwards, and left and right are alike."""
    mesh = trimesh.load(FOLDER / f'{name}.stl')
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert mesh.volume > 0.0
    assert len(mesh.faces) <= MOST_TRIANGLES
    assert mesh.bounds[:, 1].sum() == pytest.approx(0.0, abs=2 * STEP_M)


def test_shape_of_a_shell() -> None:
    """A shell has the sizes of its rows: here a rod with rounded ends."""
    rod = Shell(((0.0, 0.1, 0.02, 0.03), (0.4, 0.1, 0.02, 0.03)), ends=(0.02, 0.02))
    vertices, faces = mesh_of(rod)
    assert vertices.min(axis=0) == pytest.approx([0.08, -0.03, 0.0])
    assert vertices.max(axis=0) == pytest.approx([0.12, 0.03, 0.4])
    assert trimesh.Trimesh(vertices, faces).volume == pytest.approx(
        np.pi * 0.02 * 0.03 * (0.36 + 0.04 * 2 / 3), rel=0.02
    )


def test_same_bytes_on_every_run() -> None:
    """The file of a shell depends on nothing but the shell."""
    assert len({stl_of(*mesh_of(SHELLS['head'])) for _ in range(2)}) == 1
