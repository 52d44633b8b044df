# SPDX-License-Identifier: Apache-2.0
"""Tests of the verbs of `ros2 component` with a container that loads only names."""

from collections.abc import Callable
from functools import partial
import os
from pathlib import Path
from shlex import quote
import signal
from subprocess import CompletedProcess
import sys
from typing import Any

import pytest
from ros2component.api import container_services

Ros2 = Callable[..., CompletedProcess[str]]
Start = Callable[..., Any]

CONTAINER = Path(__file__).with_name('container.py')


@pytest.fixture
def ros2_container(ros2_here: Ros2, container: dict[str, str]) -> Ros2:
    """Return a function that runs a command which sees the container."""
    return partial(ros2_here, **container)


def test_load_list_unload(ros2_container: Ros2) -> None:
    """A component gets a number, is listed under its container, and is unloaded again."""
    assert ros2_container('component', 'list').stdout == '/container\n'
    loaded = ros2_container('component', 'load', 'container', 'demo', 'Talker')
    assert loaded.stdout == "Loaded component 1 into '/container' container node as '/talker'\n"
    words = ('-n', 'left', '--node-namespace', '/ns', '-p', 'speed:=1.5', '-r', 'a:=b', '-q')
    quiet = ros2_container('component', 'load', '/container', 'demo', 'Talker', *words)
    assert (quiet.returncode, quiet.stdout, quiet.stderr) == (0, '2\n', '')
    listed = ros2_container('component', 'list')
    assert listed.stdout == '/container\n  1  /talker\n  2  /ns/left\n'
    assert ros2_container('component', 'list', '--containers-only').stdout == '/container\n'
    unloaded = ros2_container('component', 'unload', '/container', '1', '7', '2')
    assert unloaded.stdout == (
        "Unloaded component 1 from '/container' container node\n"
        "Unloaded component 2 from '/container' container node\n"
    )
    assert unloaded.stderr == (
        "Failed to unload component 7 from '/container' container node\n"
        '    No node found with unique_id: 7\n'
    )
    assert unloaded.returncode == 1


@pytest.mark.parametrize('option', ['-q', '--quiet'])
def test_unload_quietly(ros2_container: Ros2, option: str) -> None:
    """Only what could not be unloaded is told."""
    number = ros2_container('component', 'load', '-q', 'container', 'demo', 'Talker').stdout
    unloaded = ros2_container('component', 'unload', option, '/container', number.strip(), '77')
    assert (unloaded.returncode, unloaded.stdout) == (1, '')
    assert unloaded.stderr.startswith('Failed to unload component 77 from')


def test_refused_component_is_explained(ros2_container: Ros2) -> None:
    """The container's reason is the error."""
    result = ros2_container('component', 'load', '/container', 'demo', 'Nope')
    assert (result.returncode, result.stdout) == (1, '')
    assert result.stderr == (
        'Failed to load component: Failed to find class with the requested plugin name.\n'
    )


@pytest.mark.parametrize('words', [['list'], ['load', 'a', 'b'], ['unload', '1']])
def test_unknown_container_suggests(words: list[str], ros2_container: Ros2) -> None:
    """A container that is not there is an error which names the closest one."""
    result = ros2_container('component', words[0], '/contaner', *words[1:])
    assert (result.returncode, result.stdout) == (1, '')
    assert result.stderr == (
        "Unable to find container node '/contaner'\nDid you mean '/container'?\n"
    )


@pytest.mark.parametrize(
    ('words', 'error'),
    [
        (['load', 'c', 'p', 'X', '-p', 'speed'], "'speed' is not of the form 'name:=value'"),
        (['load', 'c', 'p', 'X', '--log-level', 'loud'], "'loud' is not one of unset, debug"),
        (['unload', 'c', '-1'], "'-1' is not a whole number"),
        (['unload', 'c', 'one'], "'one' is not a whole number"),
    ],
)
def test_wrong_options_are_usage_errors(words: list[str], error: str, ros2_here: Ros2) -> None:
    """What cannot be meant is refused before a node is made."""
    result = ros2_here('component', *words)
    assert result.returncode == 2
    assert error in result.stderr


@pytest.fixture
def prefix(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Install packages with components, one of which has a container, and return where."""
    index = tmp_path / 'share' / 'ament_index' / 'resource_index'
    for kind, names in {'packages': ['demo', 'rclcpp_components', 'bare']}.items():
        (index / kind).mkdir(parents=True)
        for name in names:
            (index / kind / name).touch()
    (index / 'rclcpp_components').mkdir()
    (index / 'rclcpp_components' / 'demo').write_text(
        'demo::Talker;lib/libtalker.so\ndemo::Listener;lib/liblistener.so\n'
    )
    program = tmp_path / 'lib' / 'rclcpp_components' / 'component_container'
    program.parent.mkdir(parents=True)
    program.write_text(f'#!/bin/sh\nexec {quote(sys.executable)} {quote(str(CONTAINER))} "$@"\n')
    program.chmod(0o755)
    path = os.pathsep.join([str(tmp_path), os.environ.get('AMENT_PREFIX_PATH', '')])
    monkeypatch.setenv('AMENT_PREFIX_PATH', path)
    return tmp_path


@pytest.mark.usefixtures('prefix')
def test_types_come_from_the_index(ros2_here: Ros2) -> None:
    """The components of all packages are indented, those of one package are not."""
    types = ros2_here('component', 'types').stdout
    assert '\ndemo\n  demo::Talker\n  demo::Listener\n' in f'\n{types}'
    assert ros2_here('component', 'types', 'demo').stdout == 'demo::Talker\ndemo::Listener\n'


@pytest.mark.usefixtures('prefix')
@pytest.mark.parametrize(
    ('package', 'error'),
    [
        ('bare', "No components are registered by the package 'bare'"),
        ('nope', "Package 'nope' not found"),
    ],
)
def test_types_of_other_packages(package: str, error: str, ros2_here: Ros2) -> None:
    """A package without components is told from one that is missing."""
    result = ros2_here('component', 'types', package)
    assert (result.returncode, result.stderr.splitlines()[0]) == (1, error)


def test_standalone_ends_with_its_container(
    prefix: Path, container: dict[str, str], start_ros2: Start
) -> None:
    """A container is started for the component, and ends when the command is interrupted."""
    variables = {**container, 'AMENT_PREFIX_PATH': os.environ['AMENT_PREFIX_PATH']}
    process = start_ros2(
        'component', 'standalone', '-c', 'solo', 'demo', 'demo::Talker', extra=variables
    )
    pid = int(process.stdout.readline().split()[1])
    assert process.stdout.readline() == (
        "Loaded component 1 into '/solo' container node as '/demo::talker'\n"
    )
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=100) == 2
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)


def test_standalone_of_what_does_not_exist(ros2_here: Ros2) -> None:
    """The container's own reason is shown, and the container ends."""
    result = ros2_here('component', 'standalone', 'nope', 'demo::Talker')
    assert result.returncode == 1
    assert 'nope' in result.stderr


def test_missing_interfaces_are_explained(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without the interfaces of containers there is a sentence instead of an import error."""
    monkeypatch.setitem(sys.modules, 'composition_interfaces', None)
    with pytest.raises(RuntimeError, match="The package 'composition_interfaces' cannot"):
        container_services()
