# SPDX-License-Identifier: Apache-2.0
"""Tests of the set-up's commands, as far as they need no download."""

from __future__ import annotations

from pathlib import Path
import subprocess
import sys

import commands
from console import SetupError
from environment import require_machine
from leftovers import runs
from locations import Locations
from ownership import forget_environment, Home
import processes
from programs import wait_until
import pytest
from stamp import Stamp


@pytest.fixture
def locations(tmp_path: Path) -> Locations:
    """Return the locations of an empty workspace."""
    return Locations(tmp_path, tmp_path / '.venv', tmp_path / '.venv')


def test_an_environment_of_another_place_is_refused(locations: Locations) -> None:
    """A moved workspace gets the command that makes its environment anew."""
    home = Home(locations)
    home.require_same()
    home.write()
    home.require_same()
    Stamp(locations.environment / 'stamp' / 'home').write('/moved\n/moved/.venv\n3.11')
    with pytest.raises(SetupError, match='run `make distclean setup` to recreate it'):
        home.require_same()


@pytest.fixture
def neighbour(tmp_path: Path) -> Locations:
    """Return the locations of another workspace, with an environment."""
    root = tmp_path / 'neighbour'
    (root / 'tools' / 'setup').mkdir(parents=True)
    environment = tmp_path / 'cache' / 'humanoid-workspace' / 'a1b2'
    there = Locations(root, root / '.venv', environment)
    Home(there).write()
    return there


def test_the_environment_of_another_workspace_is_refused(
    tmp_path: Path, neighbour: Locations
) -> None:
    """Who names the environment of another workspace is asked to choose another one."""
    here = Locations(tmp_path, tmp_path / '.venv', neighbour.environment)
    with pytest.raises(SetupError) as caught:
        Home(here).require_same()
    assert str(caught.value) == (
        f'The environment in {neighbour.environment} belongs to the workspace in '
        f'{neighbour.root}: choose another VENV, as in: make setup VENV=/opt/venv'
    )


def test_the_environment_of_another_workspace_is_not_deleted(
    tmp_path: Path, neighbour: Locations, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Distclean refuses one that is named; of one that a link leads to, only the link goes."""
    monkeypatch.setenv('XDG_CACHE_HOME', str(tmp_path / 'cache'))
    monkeypatch.setattr(commands, 'ROOT', tmp_path)
    here = Locations(tmp_path, tmp_path / '.venv', neighbour.environment)
    (tmp_path / 'build').mkdir()
    with pytest.raises(SetupError, match='belongs to the workspace in .*neighbour'):
        commands.run('distclean', here, [])
    assert (tmp_path / 'build').is_dir()
    here.link.symlink_to(neighbour.environment)
    with pytest.raises(SetupError, match='make distclean setup`, which leaves that one alone'):
        Home(here).require_same()
    assert commands.run('distclean', here, []) == 0
    assert neighbour.environment.is_dir() and not here.link.is_symlink()


def test_only_the_own_environment_is_deleted(tmp_path: Path, locations: Locations) -> None:
    """Distclean leaves an environment that the user named, and its link goes."""
    locations.environment.mkdir()
    forget_environment(locations)
    assert not locations.environment.exists()
    named = tmp_path / 'named'
    named.mkdir()
    locations.link.symlink_to(named)
    forget_environment(Locations(tmp_path, locations.link, named))
    assert named.is_dir()
    assert not locations.link.is_symlink()


def test_a_machine_that_lacks_something_is_told_all_at_once(
    locations: Locations, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Everything that is missing is named before anything is downloaded."""
    monkeypatch.setenv('PATH', str(locations.root))
    with pytest.raises(SetupError, match=r'sudo apt install g\+\+'):
        require_machine(locations, has_wheels=True)


@pytest.mark.parametrize('arguments', [['nope'], ['setup', 'more'], ['--nope']])
def test_wrong_arguments_are_usage_errors(root: Path, arguments: list[str]) -> None:
    """An argument that the set-up does not know ends it with status 2 and a usage line."""
    done = subprocess.run(
        [sys.executable, str(root / 'tools' / 'setup'), *arguments],
        capture_output=True,
        encoding='utf-8',
        check=False,
    )
    assert done.returncode == 2
    assert done.stderr.startswith('usage: tools/setup')


def test_a_command_that_the_environment_lacks_is_named(root: Path) -> None:
    """A missing program means an incomplete environment; the message says what completes it."""
    done = subprocess.run(
        [root / 'tools' / 'in_environment', 'no-such-program'],
        capture_output=True,
        encoding='utf-8',
        check=False,
    )
    assert done.returncode == 1
    assert "no 'no-such-program': run 'make setup'" in done.stderr


def test_an_interruption_ends_what_was_started(monkeypatch: pytest.MonkeyPatch) -> None:
    """An exception ends the program with its children, even one that does not want to."""
    monkeypatch.setattr(processes, 'GRACE_S', 0.2)
    script = 'trap "" TERM; sleep 1000 & echo $!; wait; wait'
    pids = []
    with pytest.raises(KeyboardInterrupt):
        with processes.started(['sh', '-c', script], stdout=subprocess.PIPE) as process:
            pids = [process.pid, int(process.stdout.readline())]
            raise KeyboardInterrupt
    assert len(pids) == 2
    wait_until(lambda: not any(runs(pid) for pid in pids), 5.0, f'{pids} to end')
