# SPDX-License-Identifier: Apache-2.0
"""Tests of the explanations for launch files that are not found."""

from collections.abc import Callable
from pathlib import Path

import pytest
from ros_environment.source_tree import read_setup_script
from ros_environment.workspace import explain_missing_share_file, explain_uninstalled_file

MakePackage = Callable[..., Path]

NAME = 'robot_bringup.launch.py'
REBUILD = 'colcon build --packages-select arm && source install/setup.bash'


@pytest.fixture
def share(tmp_path: Path) -> str:
    """Install a package with one launch file."""
    folder = tmp_path / 'share' / 'arm' / 'launch'
    folder.mkdir(parents=True)
    (folder / 'sensors.launch.py').touch()
    return str(folder.parent)


def with_launch_file(folder: Path) -> Path:
    """Put the launch file into a package."""
    (folder / 'launch').mkdir()
    (folder / 'launch' / NAME).touch()
    return folder


def test_missing_from_data_files(make_package: MakePackage, share: str) -> None:
    """The line that data_files lacks is printed, with the command that installs it."""
    with_launch_file(make_package('arm', data_files="('share/x', ['package.xml'])"))
    lines = explain_missing_share_file('arm', NAME, share).splitlines()
    assert 'exists, but setup.py does not install it' in lines[0]
    assert lines[1] == (
        "    ('share/' + package_name + '/launch', ['launch/robot_bringup.launch.py']),"
    )
    assert lines[2] == f'Then rebuild: {REBUILD}'
    assert lines[3] == "The installed launch files of 'arm': sensors.launch.py."


@pytest.mark.parametrize(
    'data_files',
    [
        "('share/arm/launch', ['launch/robot_bringup.launch.py'])",
        "('share/arm/launch', glob('launch/*.launch.py'))",
        "('share/arm/launch', glob(os.path.join('launch', '*launch.[pxy][yma]*')))",
        "('share/arm/launch', glob('launch/**/*.py', recursive=True))",
    ],
)
def test_covered_by_data_files(
    data_files: str,
    make_package: MakePackage,
    share: str,
) -> None:
    """A file that a name or pattern covers needs only a rebuild."""
    with_launch_file(make_package('arm', data_files=data_files))
    text = explain_missing_share_file('arm', NAME, share)
    assert f'not installed yet. Rebuild: {REBUILD}' in text


def test_pattern_for_another_folder(make_package: MakePackage, share: str) -> None:
    """A pattern without `**` does not reach into subfolders."""
    folder = make_package('arm', data_files="('share/arm/launch', glob('launch/*.py'))")
    (folder / 'launch' / 'deep').mkdir(parents=True)
    (folder / 'launch' / 'deep' / NAME).touch()
    text = explain_missing_share_file('arm', NAME, share)
    assert "(['launch/deep" not in text
    assert "['launch/deep/robot_bringup.launch.py']" in text


def test_computed_data_files(make_package: MakePackage, share: str) -> None:
    """Where data_files is the result of a function, both causes are possible."""
    with_launch_file(make_package('arm', data_files="*tree('launch')"))
    assert 'a rebuild is enough' in explain_missing_share_file('arm', NAME, share)


def test_package_built_with_cmake(make_package: MakePackage, share: str) -> None:
    """A package without setup.py gets the line for its CMakeLists.txt."""
    folder = with_launch_file(make_package('arm'))
    (folder / 'setup.py').unlink()
    (folder / 'CMakeLists.txt').touch()
    text = explain_missing_share_file('arm', NAME, share)
    assert '    install(DIRECTORY launch DESTINATION share/${PROJECT_NAME})\n' in text


def test_path_below_a_share_folder(
    make_package: MakePackage, share: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A path that is to be installed gets the same advice; other paths get none."""
    with_launch_file(make_package('arm'))
    path = f'{share}/launch/{NAME}'
    assert explain_uninstalled_file(path) == ''
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(tmp_path))
    lines = explain_uninstalled_file(path).splitlines()
    assert 'exists, but setup.py does not install it' in lines[0]
    assert lines[-1] == f'Then rebuild: {REBUILD}'
    assert explain_uninstalled_file(f'{share}/launch/other.launch.py') == ''


def test_misspelt_name(make_package: MakePackage, share: str) -> None:
    """A misspelt name is answered with the closest installed file."""
    make_package('arm')
    assert explain_missing_share_file('arm', 'sensor.launch.py', share) == (
        "The installed launch files of 'arm': sensors.launch.py. Did you mean 'sensors.launch.py'?"
    )


def test_no_launch_files(workspace: Path, tmp_path: Path) -> None:
    """A package without launch files is told to have none."""
    text = explain_missing_share_file('arm', NAME, str(tmp_path / 'nowhere'))
    assert text == "'arm' has no installed launch files."


def test_unusual_setup_scripts(tmp_path: Path) -> None:
    """A script without a call of setup declares nothing; one with bad syntax is None."""
    script = tmp_path / 'setup.py'
    script.write_text('import setuptools\nsetuptools.setup(data_files=files)\n')
    found = read_setup_script(script)
    assert found is not None
    assert (found.scripts, found.data_is_computed) == ({}, True)
    script.write_text('def\n')
    assert read_setup_script(script) is None
