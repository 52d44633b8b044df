# SPDX-License-Identifier: Apache-2.0
"""Check that meshes which are not there are found."""

from __future__ import annotations

from pathlib import Path

from humanoid_description.check_model import main
import pytest

SHARE = 'package://humanoid_description'
MISSING = {
    'no package': (
        'package://humanoid_descriptio/m.stl',
        "there is no package 'humanoid_descriptio'. Did you mean 'humanoid_description'?",
    ),
    'no such package': ('package://nope/m.stl', "there is no package 'nope'. Install or build"),
    'no file': (f'{SHARE}/config/robot_vie.rviz', "Did you mean 'robot_view.rviz'?"),
    'no folder': (f'{SHARE}/mesh/arm.stl', 'there is no folder '),
    'a folder': (f'{SHARE}/config', "/config' is a folder."),
    'no path': ('file:///nowhere/arm.stl', "there is no folder '/nowhere'."),
    'beside the model': ('arm.stl', 'Install it, or correct the name.'),
}


def status(folder: Path, mesh: str) -> int:
    """Check a model with one mesh."""
    visual = f'<visual><geometry><mesh filename="{mesh}"/></geometry></visual>'
    model = folder / 'm.urdf'
    model.write_text(f'<robot name="r">\n<link name="a">{visual}</link></robot>')
    return main([str(model)])


@pytest.mark.parametrize('name', MISSING)
def test_missing_mesh(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A mesh that is not there is a defect, with the line of its link and the cause."""
    mesh, reason = MISSING[name]
    assert status(tmp_path, mesh) == 1
    out = capsys.readouterr().out
    assert f"- line 2: The mesh '{mesh}' of link 'a' was not found: " in out
    assert reason in out


def test_mesh_that_is_there(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A file may be in a package, anywhere, or beside the model; others are not looked for."""
    (tmp_path / 'a b.stl').touch()
    uri = (tmp_path / 'a b.stl').as_uri()
    for mesh in (uri, 'a b.stl', f'{SHARE}/package.xml', 'https://example.org/arm.stl'):
        assert status(tmp_path, mesh) == 0
    assert ' 1 file, 1 remote not checked ' in capsys.readouterr().out
