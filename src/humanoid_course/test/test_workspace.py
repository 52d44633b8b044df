# SPDX-License-Identifier: Apache-2.0
"""Check how the student's workspace and packages are found."""

from __future__ import annotations

from pathlib import Path

from humanoid_common.errors import UserError
from humanoid_course.testing import MODEL_AND_CONTROL, write_workspace
from humanoid_course.workspace import find_packages, find_workspace
import pytest


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    """Return a workspace with the packages of exercise 3."""
    return write_workspace(tmp_path / 'ros2_ws', MODEL_AND_CONTROL)


@pytest.mark.parametrize('here', ['.', 'src', 'src/robot_control/launch'])
def test_upwards(workspace: Path, here: str) -> None:
    """The workspace is found from any of its folders."""
    folder, packages = find_workspace(None, ['robot_control'], workspace / here, {})
    assert folder == workspace and sorted(packages) == ['robot_control', 'robot_description']


def test_sourced_workspace(workspace: Path, tmp_path: Path) -> None:
    """Elsewhere it is the one that is sourced."""
    sourced = {'COLCON_PREFIX_PATH': f'/opt/ros/jazzy:{workspace}/install'}
    other = tmp_path / 'other'
    other.mkdir()
    assert find_workspace(None, ['robot_control'], other, sourced)[0] == workspace


@pytest.mark.parametrize(
    ('given', 'wanted', 'words'),
    [
        (
            None,
            'robot_contrl',
            "no package 'robot_contrl' in .*Did you mean 'robot_control'",
        ),
        (None, 'zzz', 'Packages there: robot_control, robot_description. .*--package'),
        ('nowhere', 'robot_control', "There is no folder 'nowhere'"),
        ('~no_one/ros2_ws', 'robot_control', "there is no home folder '~no_one'"),
    ],
)
def test_not_found(workspace: Path, given: str | None, wanted: str, words: str) -> None:
    """What is not found is one sentence with the closest name."""
    with pytest.raises(UserError, match=words) as caught:
        find_workspace(given, [wanted], workspace, {})
    assert '\n' not in str(caught.value)


def test_no_workspace(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """The home folder is not searched."""
    monkeypatch.setenv('HOME', str(tmp_path))
    with pytest.raises(UserError, match='There is no workspace here'):
        find_workspace(None, ['robot_control'], tmp_path, {})


def test_ignored_packages(workspace: Path) -> None:
    """Packages that colcon ignores, and build folders, are not searched."""
    (workspace / 'src' / 'robot_control' / 'COLCON_IGNORE').touch()
    write_workspace(workspace / 'install', MODEL_AND_CONTROL)
    assert list(find_packages(workspace)) == ['robot_description']


def test_broken_manifest(workspace: Path) -> None:
    """A package whose manifest cannot be read has the name of its folder."""
    (workspace / 'src' / 'robot_control' / 'package.xml').write_text('<package>')
    assert 'robot_control' in find_packages(workspace)
