# SPDX-License-Identifier: Apache-2.0
"""Tests of the readers of facts, on files made for them and on this machine."""

from __future__ import annotations

from collections.abc import Iterator
import os
from pathlib import Path
import sys

import pytest
from ros2doctor.check.environment import environment_findings, read_environment
from ros2doctor.check.graph import why_rclpy_does_not_start
from ros2doctor.check.graphics import read_graphics
from ros2doctor.check.libraries import library_findings, read_libraries
from ros2doctor.check.network import read_network
from ros2doctor.check.scripts import read_script
from ros2doctor.check.transports import multicast_error
from ros2doctor.check.wheels import (
    environment_prefix,
    install_command,
    is_own,
    normal_name,
    pins,
    python_version,
    read_wheels,
)
from ros2doctor.check.workspace import changed_files, read_workspaces
from ros_environment.source_tree import SourcePackage

BUILT_S = 1_000_000
BEFORE, AFTER = BUILT_S - 100, BUILT_S + 100

# A first line cannot name a path with spaces, to which `.venv` may be a link from there.
PYTHON = os.path.join(os.path.realpath(sys.prefix), 'bin', os.path.basename(sys.executable))


def write(path: Path, text: str, time_s: float) -> Path:
    """Write a file of a certain time."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    os.utime(path, (time_s, time_s))
    return path


@pytest.fixture
def package(tmp_path: Path) -> SourcePackage:
    """Make a package that is built and installed."""
    folder = tmp_path / 'ws/src/arm'
    write(folder / 'package.xml', '<package><name>arm</name></package>', BEFORE)
    write(tmp_path / 'ws/install/arm/share/colcon-core/packages/arm', '', BUILT_S)
    write(tmp_path / 'ws/install/arm/share/ament_index/resource_index/packages/arm', '', BUILT_S)
    write(tmp_path / 'ws/install/arm/share/arm/launch/a.launch.py', 'old', BEFORE)
    write(tmp_path / 'ws/install/arm/lib/python3.12/site-packages/arm/node.py', 'old', BEFORE)
    return SourcePackage('arm', folder)


def changes(package: SourcePackage) -> list[str]:
    """Return the changed files of a package, sorted."""
    return sorted(changed_files(package, package.folder.parents[1] / 'install' / 'arm'))


def test_changed_files_are_found(package: SourcePackage) -> None:
    """What is newer than the build and differs from its copy is changed, modules as well."""
    write(package.folder / 'launch/a.launch.py', 'new', AFTER)
    write(package.folder / 'arm/node.py', 'new', AFTER)
    write(package.folder / 'src/driver.cpp', 'new', AFTER)
    write(package.folder / 'setup.py', 'new', AFTER)
    assert changes(package) == ['arm/node.py', 'launch/a.launch.py', 'setup.py', 'src/driver.cpp']


def test_new_files_are_found(package: SourcePackage) -> None:
    """A new file counts where others of its kind are installed."""
    write(package.folder / 'launch/b.launch.py', 'new', AFTER)
    write(package.folder / 'arm/other.py', 'new', AFTER)
    write(package.folder / 'LICENSE', 'new', AFTER)
    write(package.folder / 'doc/a.md', 'new', AFTER)
    assert changes(package) == ['arm/other.py', 'launch/b.launch.py']


def test_what_is_no_change(package: SourcePackage) -> None:
    """Touched files, those of before the build, and those that are never installed, are not."""
    write(package.folder / 'launch/a.launch.py', 'old', AFTER)
    write(package.folder / 'arm/node.py', 'new', BEFORE)
    write(package.folder / 'README.md', 'new', AFTER)
    write(package.folder / 'test/test_a.py', 'new', AFTER)
    assert changes(package) == []


def test_workspace_around_the_folder(
    package: SourcePackage, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The workspace is found from a folder inside of it, with the state of its packages."""
    monkeypatch.chdir(package.folder)
    monkeypatch.setenv('AMENT_PREFIX_PATH', '')
    monkeypatch.setenv('COLCON_PREFIX_PATH', '')
    [workspace] = read_workspaces()
    [state] = workspace.packages
    assert workspace.folder == package.folder.parents[1]
    assert (state.name, state.is_built, state.is_known) == ('arm', True, False)


@pytest.mark.parametrize(
    'line, interpreter, expected',
    [
        (f'#!{PYTHON}', PYTHON, (True, True, True, True)),
        ('#!/gone/python3 -s', '/gone/python3', (True, False, True, False)),
        ('#!/bin/sh', '/bin/sh', (True, True, False, False)),
        ('#!/usr/bin/env nothing_of_this_name', 'nothing_of_this_name', (False, False)),
    ],
)
def test_first_lines(
    tmp_path: Path, line: str, interpreter: str, expected: tuple[bool, ...]
) -> None:
    """The interpreter is read from the first line, and compared with this one."""
    script = read_script(write(tmp_path / 'x', f'{line}\n', 0))
    assert script is not None
    assert script.interpreter == interpreter
    found = (script.is_fixed, script.exists, script.is_python, script.is_own)
    assert found[: len(expected)] == expected


@pytest.mark.parametrize('text', ['\x7fELF', '', 'text', '#!'])
def test_what_is_no_script(tmp_path: Path, text: str) -> None:
    """A program or an empty file names no interpreter; neither does one that does not exist."""
    assert read_script(write(tmp_path / 'x', text, 0)) is None
    assert read_script(tmp_path / 'nope') is None


def test_pins_are_those_of_this_python() -> None:
    """Lines for other versions of Python do not count, nor do comments."""
    text = (
        '# comment\nPy_YAML==6.0\n'
        "numpy==2.2 ; python_version < '3.0'\n"
        "numpy==2.4 ; python_version >= '3.0'\n"
    )
    assert pins(text) == {'py-yaml': '6.0', 'numpy': '2.4'}
    assert normal_name('Ros_Rcl.X') == 'ros-rcl-x'


@pytest.fixture
def environment(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Make and source an environment in a workspace with a space in its name."""
    folder = tmp_path / 'w s' / '.venv'
    write(folder / 'pyvenv.cfg', 'home = /usr/bin\nversion = 3.4.1\n', 0)
    write(folder / 'stamp/home', f'{folder.parent}\n', 0)
    write(folder.parent / 'requirements.txt', '', 0)
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(folder))
    environment_prefix.cache_clear()
    yield folder
    environment_prefix.cache_clear()


def test_version_of_the_environment(environment: Path) -> None:
    """Pins are those of the environment's Python, also where another Python runs the doctor."""
    assert python_version() == '3.4.1'
    assert pins("numpy==2.2 ; python_version < '3.5'\n") == {'numpy': '2.2'}
    assert is_own(f'{environment}/bin/python3')


def test_environment_is_installed_again(environment: Path) -> None:
    """The command is for the workspace that made the environment, and makes a moved one anew."""
    root = environment.parent
    again = install_command()
    assert again.startswith(f"rm -f '{environment}/stamp/wheels' ")
    assert again.endswith(f" && make -C '{root}' setup")
    write(environment / 'stamp/home', '/gone\n', 0)
    assert install_command() == f"make -C '{root}' distclean build"
    (environment / 'stamp/home').unlink()
    assert 'pip' in install_command()


def test_this_machine() -> None:
    """The environment in which the tests run is found to be in order."""
    facts = read_environment()
    assert facts.prefix == sys.prefix
    assert [f for f in environment_findings(facts) if 'rclpy' in f.what] == []
    assert [f for f in library_findings(read_libraries(), '') if f.why.startswith('they')] == []
    assert read_wheels().installed['ros-rclpy']
    assert why_rclpy_does_not_start() == ''
    assert set(read_graphics().libraries) == {'GL', 'EGL', 'OSMesa'}


def test_this_network() -> None:
    """The loopback interface is there; a packet to an address that is not here is not."""
    facts = read_network()
    assert [each.address for each in facts.interfaces if each.is_loopback] == ['127.0.0.1']
    assert 'lo' in facts.multicast
    assert isinstance(multicast_error('192.0.2.77'), OSError)
