# SPDX-License-Identifier: Apache-2.0
"""Tests of the explanations for packages that are not found."""

from collections.abc import Callable
from pathlib import Path

import pytest
from ros_environment.source_tree import find_workspace, source_packages
from ros_environment.workspace import explain_missing_package

MakePackage = Callable[..., Path]


def install(workspace: Path, package: str, *, merged: bool = False) -> Path:
    """Make the marker of an installed package and return its prefix."""
    prefix = workspace / 'install' / ('' if merged else package)
    index = prefix / 'share' / 'ament_index' / 'resource_index' / 'packages'
    index.mkdir(parents=True, exist_ok=True)
    (index / package).touch()
    return prefix


@pytest.mark.parametrize('merged', [False, True])
def test_built_but_not_sourced(
    merged: bool,
    workspace: Path,
    make_package: MakePackage,
) -> None:
    """A package that is built is made known by sourcing the workspace."""
    make_package('arm')
    install(workspace, 'arm', merged=merged)
    text = explain_missing_package('arm')
    assert text.startswith("'arm' is built in '")
    assert text.endswith('Run: source install/setup.bash')


def test_in_source_tree_but_not_built(workspace: Path, make_package: MakePackage) -> None:
    """A package that is only in the source tree is to be built and sourced."""
    folder = make_package('arm')
    text = explain_missing_package('arm')
    assert str(folder) in text
    assert text.endswith('Run: colcon build --packages-select arm && source install/setup.bash')


def test_command_leads_to_the_workspace(
    make_package: MakePackage,
    workspace: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Inside a package the command changes to the workspace first."""
    monkeypatch.chdir(make_package('arm'))
    assert f"Run: cd '{workspace}' && colcon build" in explain_missing_package('arm')


def test_sourced_workspace_is_known_from_elsewhere(
    make_package: MakePackage,
    workspace: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A workspace that has been sourced is searched from every folder."""
    make_package('arm')
    install(workspace, 'other')
    elsewhere = tmp_path / 'elsewhere'
    elsewhere.mkdir()
    monkeypatch.chdir(elsewhere)
    monkeypatch.setenv('COLCON_PREFIX_PATH', str(workspace / 'install'))
    assert 'has not been built' in explain_missing_package('arm')


def test_nothing_sourced(workspace: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without any prefix the environment itself is missing."""
    monkeypatch.delenv('AMENT_PREFIX_PATH')
    assert 'source install/setup.bash' in explain_missing_package('arm')


def test_misspelt_name(
    workspace: Path,
    make_package: MakePackage,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A misspelt name is answered with the closest one, installed or in the source tree."""
    make_package('humanoid_control')
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(install(workspace, 'sensor_msgs')))
    assert "Did you mean 'humanoid_control'?" in explain_missing_package('humanoid_controll')
    assert "Did you mean 'sensor_msgs'?" in explain_missing_package('sensor_msg')
    assert 'Did you mean' not in explain_missing_package('xyz')


def test_ignored_folders_are_not_searched(workspace: Path, make_package: MakePackage) -> None:
    """A package below an ignore marker does not exist for colcon, so it does not for us."""
    make_package('arm')
    make_package('nested', below='src/group')
    make_package('old', below='src/attic')
    (workspace / 'src' / 'attic' / 'COLCON_IGNORE').touch()
    make_package('inside', below='src/arm/vendor')
    assert sorted(source_packages(workspace)) == ['arm', 'nested']


def test_broken_manifest_is_skipped(workspace: Path, make_package: MakePackage) -> None:
    """A manifest that is no XML hides its package, not the others."""
    make_package('arm')
    (make_package('leg') / 'package.xml').write_text('<package')
    assert list(source_packages(workspace)) == ['arm']


def test_workspace_is_nearest_folder_with_packages(
    workspace: Path,
    make_package: MakePackage,
    tmp_path: Path,
) -> None:
    """A `src` folder without packages does not make a workspace."""
    folder = make_package('arm')
    (folder / 'src').mkdir()
    assert find_workspace(folder / 'src') == workspace
    assert find_workspace(tmp_path / 'elsewhere') is None


def test_package_that_is_built_on_demand(workspace: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A package that waits in the environment is explained by what builds it."""
    prefix = install(workspace, 'arm')
    waiting = prefix / 'share' / 'ament_index' / 'resource_index' / 'on_demand'
    waiting.mkdir(parents=True)
    (waiting / 'navigation2').write_text('nav2 slam\nnavigation2 is not built yet: run this\n')
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(prefix))
    text = explain_missing_package('nav2_bringup')
    assert text.startswith("'nav2_bringup' is not available yet") and text.endswith('run this')
    assert 'run this' not in explain_missing_package('gripper')


def test_deleted_current_folder(
    make_package: MakePackage, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In a folder that has been deleted the explanation is still a sentence."""
    make_package('arm')
    gone = tmp_path / 'gone'
    gone.mkdir()
    monkeypatch.chdir(gone)
    monkeypatch.setenv('PWD', str(gone))
    gone.rmdir()
    assert explain_missing_package('leg')
