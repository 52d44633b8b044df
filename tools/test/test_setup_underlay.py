# SPDX-License-Identifier: Apache-2.0
"""Tests of which packages of the underlay are built when, and of those that wait."""

from __future__ import annotations

from collections.abc import Callable
import os
from pathlib import Path
import subprocess
import sys

import colcon
from console import Steps
from locations import Locations
from packages import needed, read_packages
import pytest
from ros_environment.installed import built_on_demand
from underlay import Underlay

MANIFEST = '<package><name>{name}</name>{rest}</package>'
INTERFACES = '<member_of_group>rosidl_interface_packages</member_of_group>'


def write_package(folder: Path, *dependencies: str, interfaces: bool = False) -> None:
    """Write a package with these dependencies, and if it is one of interfaces a message."""
    rest = ''.join(f'<exec_depend>{name}</exec_depend>' for name in dependencies)
    folder.mkdir(parents=True)
    manifest = MANIFEST.format(name=folder.name, rest=rest + INTERFACES * interfaces)
    (folder / 'package.xml').write_text(manifest)
    if interfaces:
        (folder / 'msg').mkdir()
        (folder / 'msg' / 'Thing.msg').write_text('float64 size_m\n')


@pytest.fixture
def workspace(tmp_path: Path) -> Locations:
    """Return a workspace whose robot needs `used_msgs`, but not `other_msgs`."""
    underlay = tmp_path / 'tools' / 'underlay'
    write_package(underlay / 'ros_environment')
    write_package(underlay / 'tool', 'tool_msgs')
    for name in ('base_msgs', 'tool_msgs', 'geo_msgs'):
        write_package(underlay / name, interfaces=True)
    write_package(underlay / 'used_msgs', 'base_msgs', interfaces=True)
    write_package(underlay / 'other_msgs', 'geo_msgs', interfaces=True)
    write_package(tmp_path / 'src' / 'group' / 'robot', 'used_msgs', 'rclpy')
    (tmp_path / 'colcon.meta').touch()
    (tmp_path / '.venv' / 'lib' / 'python3.12' / 'site-packages').mkdir(parents=True)
    return Locations(tmp_path, tmp_path / '.venv', tmp_path / '.venv')


@pytest.fixture
def left_out() -> list[list[str]]:
    """Return the list of what colcon is kept from in each build from now on."""
    return []


@pytest.fixture
def built(monkeypatch: pytest.MonkeyPatch, left_out: list[list[str]]) -> list[list[str]]:
    """Return the list of what is built from now on; the package `broken` fails."""
    runs: list[list[str]] = []

    def build(
        _: Locations,
        __: Steps,
        names: list[str],
        waiting: list[str],
        finished: Callable[[str], None],
    ) -> None:
        runs.append(names)
        left_out.append(waiting)
        for name in names:
            if (_.underlay / name / 'broken').exists():
                raise KeyboardInterrupt
            finished(name)

    monkeypatch.setattr(colcon, 'build_underlay', build)
    return runs


def make(workspace: Locations, *, everything: bool = False, requirements: str = 'wheels') -> None:
    """Build what is wanted and stale, as a command does; describe the rest."""
    underlay = Underlay(workspace, requirements)
    names = underlay.to_build(everything=everything)
    if names:
        underlay.build(names, Steps(1))
    underlay.describe_others()


NEEDED = ['base_msgs', 'ros_environment', 'tool', 'tool_msgs', 'used_msgs']


def test_messages_that_nobody_uses_wait(workspace: Locations, built: list[list[str]]) -> None:
    """The robot's are built first, the others when everything is asked for, each once."""
    make(workspace)
    make(workspace)
    assert built == [NEEDED]
    make(workspace, everything=True)
    make(workspace, everything=True)
    make(workspace)
    assert built == [NEEDED, ['geo_msgs', 'other_msgs']]


def test_who_depends_on_messages_gets_them(workspace: Locations, built: list[list[str]]) -> None:
    """A package.xml that names them is enough, also with what they need themselves."""
    make(workspace)
    write_package(workspace.root / 'src' / 'navigator', 'other_msgs')
    make(workspace)
    assert built == [NEEDED, ['geo_msgs', 'other_msgs']]


def test_a_change_is_built_with_what_is_compiled_against_it(
    workspace: Locations, built: list[list[str]]
) -> None:
    """Of messages those that include them; of a program itself; of the wheels everything."""
    make(workspace, everything=True)
    (workspace.underlay / 'base_msgs' / 'msg' / 'Thing.msg').write_text('float32 size_m\n')
    make(workspace)
    (workspace.underlay / 'tool' / 'tool.py').touch()
    make(workspace)
    (workspace.underlay / 'geo_msgs' / 'msg' / 'More.msg').touch()
    make(workspace)
    make(workspace, requirements='others')
    assert built[1:4] == [['base_msgs', 'used_msgs'], ['tool'], ['geo_msgs', 'other_msgs']]
    assert built[4] == sorted([*NEEDED, 'geo_msgs', 'other_msgs'])


def test_an_interrupted_build_goes_on(workspace: Locations, built: list[list[str]]) -> None:
    """What was finished before stays; the rest is built by the next call."""
    broken = workspace.underlay / 'tool' / 'broken'
    broken.touch()
    with pytest.raises(KeyboardInterrupt):
        make(workspace)
    broken.unlink()
    make(workspace)
    assert built[1] == ['tool', 'tool_msgs', 'used_msgs']


def test_a_module_that_is_gone_is_removed(workspace: Locations, built: list[list[str]]) -> None:
    """Its copies would still be imported, and a folder would hide the module of its name."""
    build = workspace.environment / 'build' / 'tool'
    packages = workspace.environment / 'lib' / 'python3.12' / 'site-packages'
    (workspace.underlay / 'tool' / 'tool').mkdir()
    (workspace.underlay / 'tool' / 'tool' / 'verb.py').touch()
    installed = []
    for top in (build / 'build' / 'lib', packages):
        for name in ('verb.py', 'old/__init__.py', 'old/inner/__init__.py'):
            path = top / 'tool' / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.touch()
            cache = path.parent / '__pycache__'
            cache.mkdir(exist_ok=True)
            (cache / f'{path.stem}.cpython-312.pyc').touch()
            installed.append(str(path))
    strange = packages / 'tool' / 'of_another.py'
    strange.touch()
    (build / 'install.log').write_text('\n'.join(installed[3:]))

    Underlay(workspace, '1').build(['tool'], Steps(1))

    for top in (build / 'build' / 'lib', packages):
        assert (top / 'tool' / 'verb.py').exists() and not (top / 'tool' / 'old').exists()
    assert strange.exists()


@pytest.mark.parametrize('arguments', [[], ['--packages-select', 'robot']])
def test_a_build_of_some_packages_removes_nothing(
    workspace: Locations, monkeypatch: pytest.MonkeyPatch, arguments: list[str]
) -> None:
    """What another package has generated would not come back."""
    monkeypatch.setattr(colcon, 'run', lambda *_, **__: 0)
    gone = workspace.root / 'build' / 'robot' / 'build' / 'lib' / 'robot' / 'gone.py'
    gone.parent.mkdir(parents=True)
    gone.touch()
    assert colcon.build_workspace(workspace, arguments) == 0
    assert gone.exists() == bool(arguments)


def test_messages_that_wait_are_described(workspace: Locations, built: list[list[str]]) -> None:
    """They are in the index, with their definitions; an import says what to do."""
    make(workspace)
    environment = workspace.environment
    index = environment / 'share' / 'ament_index' / 'resource_index'
    assert sorted(path.name for path in (index / 'packages').iterdir()) == [
        'geo_msgs',
        'other_msgs',
    ]
    assert (index / 'rosidl_interfaces' / 'other_msgs').read_text() == 'msg/Thing.msg'
    shown = environment / 'share' / 'other_msgs' / 'msg' / 'Thing.msg'
    assert shown.read_text() == 'float64 size_m\n'
    sentence = (
        'other_msgs is not built yet, because nothing in src/ depends on it: run `make setup` '
        f'in {workspace.root}'
    )
    done = subprocess.run(
        [sys.executable, '-c', 'import other_msgs.msg'],
        cwd=environment / 'lib' / 'python3.12' / 'site-packages',
        capture_output=True,
        text=True,
    )
    assert done.stderr.splitlines()[-1] == f'ImportError: {sentence}'
    found = environment / 'share' / 'other_msgs' / 'cmake' / 'other_msgsConfig.cmake'
    done = subprocess.run(['cmake', '-P', found], capture_output=True, text=True)
    assert done.returncode == 1 and sentence in ' '.join(done.stderr.split())


def test_what_is_built_is_no_longer_described(
    workspace: Locations, built: list[list[str]]
) -> None:
    """A package whose building was interrupted is described anew, not left half."""
    make(workspace)
    package = workspace.environment / 'lib' / 'python3.12' / 'site-packages' / 'geo_msgs'
    broken = workspace.underlay / 'other_msgs' / 'broken'
    broken.touch()
    with pytest.raises(KeyboardInterrupt):
        make(workspace, everything=True)
    (package / '__init__.py').write_text('')  # as the build of geo_msgs installs it
    known_to_colcon = workspace.environment / 'share' / 'colcon-core' / 'packages' / 'other_msgs'
    known_to_colcon.parent.mkdir(parents=True)
    known_to_colcon.touch()  # as an interrupted build leaves it
    make(workspace)
    assert not known_to_colcon.exists()
    assert (package / '__init__.py').read_text() == ''
    other = package.parent / 'other_msgs' / '__init__.py'
    assert 'is not built yet' in other.read_text()


def test_what_the_robot_needs_is_found_in_its_packages(root: Path) -> None:
    """Navigation is not needed to stand; messages of tf2 are, though only others use them."""
    underlay = read_packages(root / 'tools' / 'underlay')
    names = needed(underlay, read_packages(root / 'src'))
    assert 'tf2_msgs' in names and 'launch' in names
    assert 'nav2_msgs' not in names and 'vision_msgs' not in names
    others = {underlay[name] for name in set(underlay) - names}
    assert all(package.is_interface or package.on_demand for package in others)
    asked = needed(underlay, read_packages(root / 'src'), 'navigation:=true')
    assert {'navigation2', 'nav2_msgs', 'slam_toolbox'} <= asked - names
    seeing = needed(underlay, read_packages(root / 'src'), 'perception:=true')
    assert {'vision_msgs', 'nav2_msgs'} <= seeing - names
    assert 'slam_toolbox' not in seeing
    tutorial = needed(underlay, read_packages(root / 'src'), 'run demo_nodes_py talker')
    demos = {'demo_nodes_cpp', 'demo_nodes_py', 'example_interfaces'}
    assert tutorial - names == demos
    drawing = needed(underlay, read_packages(root / 'src'), 'run turtlesim turtlesim_node')
    assert drawing - names == {'turtlesim'}


@pytest.mark.parametrize(
    ('command', 'status', 'sentence'),
    [
        ('interface show other_msgs/msg/Thing', 0, 'float64 size_m'),
        ('interface list', 0, 'other_msgs/msg/Thing'),
        ('pkg prefix other_msgs', 0, '/.venv'),
        ('topic pub --once /thing other_msgs/msg/Thing', 1, 'run `make setup` in'),
        ('interface proto other_msgs/msg/Thing', 1, 'run `make setup` in'),
    ],
)
def test_ros2_knows_messages_that_wait(
    workspace: Locations, built: list[list[str]], command: str, status: int, sentence: str
) -> None:
    """It finds and shows them; where it has to use them, it says what to do."""
    make(workspace)
    environment = workspace.environment
    packages = environment / 'lib' / 'python3.12' / 'site-packages'
    paths = {'AMENT_PREFIX_PATH': environment, 'PYTHONPATH': packages}
    variables = {
        name: os.pathsep.join([str(path), os.environ.get(name, '')])
        for name, path in paths.items()
    }
    done = subprocess.run(
        ['ros2', *command.split()],
        env={**os.environ, **variables},
        capture_output=True,
        text=True,
    )
    printed = done.stdout + done.stderr
    assert (done.returncode, 'Traceback' in printed) == (status, False), printed
    assert sentence in ' '.join(printed.split())


def on_demand(package: Path, words: str) -> None:
    """Let a package be one that is built on demand."""
    manifest = package / 'package.xml'
    export = f'<export><on_demand>{words}</on_demand></export></package>'
    manifest.write_text(manifest.read_text().replace('</package>', export))


def test_what_is_built_on_demand(workspace: Locations, built: list[list[str]]) -> None:
    """A package on demand waits, with what only it needs, until a command names it."""
    write_package(workspace.underlay / 'pilot', 'geo_msgs')
    on_demand(workspace.underlay / 'pilot', 'pilot route')
    write_package(workspace.root / 'src' / 'flight', 'pilot', 'other_msgs')
    for asked_for in ('', 'scene:=flat route:=false'):
        names = Underlay(workspace, 'wheels', asked_for).to_build(everything=False)
        assert names == NEEDED
    for asked_for in ('route:=true', 'run pilot_tools start'):
        names = Underlay(workspace, 'wheels', asked_for).to_build(everything=False)
        assert set(names) == {*NEEDED, 'geo_msgs', 'other_msgs', 'pilot'}


def test_interfaces_on_demand(workspace: Locations, built: list[list[str]]) -> None:
    """A command that names a package gets it, also one that defines interfaces of its own."""
    on_demand(workspace.underlay / 'other_msgs', 'other')
    for asked_for, more in (('', []), ('run other_msgs start', ['other_msgs', 'geo_msgs'])):
        names = Underlay(workspace, 'wheels', asked_for).to_build(everything=False)
        assert names == sorted([*NEEDED, *more])


def test_colcon_does_not_know_what_waits(
    workspace: Locations, built: list[list[str]], left_out: list[list[str]]
) -> None:
    """It would refuse a package that depends, for its tests, on one that is built on demand."""
    write_package(workspace.underlay / 'pilot')
    on_demand(workspace.underlay / 'pilot', 'pilot')
    write_package(workspace.underlay / 'panel', 'pilot')
    make(workspace)
    make(workspace, everything=True)
    (workspace.underlay / 'panel' / 'panel.py').touch()
    make(workspace)
    assert built == [sorted([*NEEDED, 'panel']), ['geo_msgs', 'other_msgs', 'pilot'], ['panel']]
    assert left_out == [['geo_msgs', 'other_msgs', 'pilot'], [], []]


def test_what_is_said_of_packages_on_demand(
    workspace: Locations, built: list[list[str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Who looks for one is told to build it, until it is built."""
    write_package(workspace.underlay / 'pilot')
    on_demand(workspace.underlay / 'pilot', 'pilot')
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(workspace.environment))
    make(workspace)
    assert 'make setup' in built_on_demand('pilot_tools')
    assert not built_on_demand('arm')
    make(workspace, everything=True)
    assert not built_on_demand('pilot_tools')
