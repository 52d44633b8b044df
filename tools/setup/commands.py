# SPDX-License-Identifier: Apache-2.0
"""The commands of the set-up: setup, cluster, mirror, build, prepare, tests, site, cleaning."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
import fcntl
import os
from pathlib import Path
import signal
import sys

import colcon
from console import SetupError
import environment
from locations import expanded_path, find_locations, Locations
import mirror
from ownership import (
    forget_environment,
    python_version,
    refuse_what_belongs_to_others,
    remove,
)
import processes
from stamp import digest, Stamp

ROOT = Path(__file__).resolve().parents[2]
BUILT = ('build', 'install', 'log', 'site')
MIRRORED = (
    environment.REQUIREMENTS,
    environment.PART_REQUIREMENTS,
    environment.TEST_REQUIREMENTS,
)
"""What `make mirror` collects: everything but Ray and the generator of the site."""
_USE_MIRROR = ('setup', 'build', 'prepare', 'tests')


def main(argv: list[str]) -> int:
    """
    Run a command of the set-up, report an error or interruption, and return the exit status.

    Parameters
    ----------
    argv
        Command-line arguments, without the name of the program.

    Returns
    -------
    int
        That of the command, 1 after an error, or 130 after an interruption.

    """
    options, rest = parse(argv)
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.default_int_handler)
    try:
        locations = find_locations(ROOT, options.venv)
        if options.wheels and options.command in _USE_MIRROR:
            mirror.use_mirror(options.wheels)
        with only_one_at_a_time(ROOT):
            if options.command == 'mirror':
                return make_mirror(locations, options.wheels or str(ROOT / 'wheels'))
            return run(options.command, locations, rest)
    except SetupError as error:
        print(f'\n{error}', file=sys.stderr)
    except OSError as error:
        print(f'\n{explain_os_error(error)}', file=sys.stderr)
    except KeyboardInterrupt:
        print('\nInterrupted: the same command continues from here.', file=sys.stderr)
        return 130
    return 1


def parse(argv: list[str]) -> tuple[argparse.Namespace, list[str]]:
    """
    Parse the command line; unknown arguments of `build` are passed to colcon.

    Parameters
    ----------
    argv
        Command-line arguments, without the name of the program.

    Returns
    -------
    Namespace, list of str
        The options `command`, `venv` and `wheels`, and the arguments for `colcon build`.

    """
    parser = argparse.ArgumentParser(prog='tools/setup', description=__doc__)
    commands = [
        *('setup', 'cluster', 'mirror', 'build', 'prepare'),
        *('tests', 'site', 'clean', 'distclean'),
    ]
    parser.add_argument('command', nargs='?', default='setup', choices=commands)
    parser.add_argument('--venv', default=os.environ.get('VENV'), help='the environment to use')
    parser.add_argument(
        '--wheels', default=os.environ.get('WHEELS'), help='a folder of wheels, instead of PyPI'
    )
    options, rest = parser.parse_known_args(argv)
    if rest and options.command != 'build':
        parser.error(f'unrecognized arguments: {" ".join(rest)}')
    return options, rest


def run(command: str, locations: Locations, arguments: list[str]) -> int:
    """
    Run one command of the set-up and return its exit status.

    Parameters
    ----------
    command
        One of `setup`, `cluster`, `build`, `prepare`, `tests`, `site`, `clean` and `distclean`.
    locations
        The workspace and its environment.
    arguments : list[str]
        Further arguments of `colcon build`, which only `build` uses.

    Raises
    ------
    SetupError
        The machine lacks something, a step failed, or another workspace owns the environment.

    """
    if command == 'setup':
        return environment.set_up(locations)
    if command == 'build':
        return environment.set_up(locations, quiet=True) or build(locations, arguments)
    if command == 'prepare':
        status = environment.set_up(locations, quiet=True, everything=False)
        return status or build(locations, [])
    if command == 'tests':
        return environment.set_up(locations, quiet=True) or environment.set_up_tests(locations)
    if command == 'cluster':
        return environment.set_up(locations, quiet=True) or environment.set_up_cluster(locations)
    if command == 'site':
        return environment.build_site(locations)
    if command == 'distclean':
        refuse_what_belongs_to_others(locations)
        forget_environment(locations)
    remove(ROOT / name for name in BUILT)
    return 0


@contextmanager
def only_one_at_a_time(root: Path) -> Iterator[None]:
    """
    Lock a workspace against a second set-up or build, waiting for a running one.

    Programs that are started meanwhile inherit the lock, so that the next one also waits for
    processes left behind by a killed set-up.

    Parameters
    ----------
    root
        The folder of the workspace.

    """
    descriptor = os.open(root / 'tools' / 'setup', os.O_RDONLY)
    try:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            print('Another set-up or build of this workspace is running: waiting for it.')
            fcntl.flock(descriptor, fcntl.LOCK_EX)
        processes.KEPT_OPEN.append(descriptor)
        yield
    finally:
        os.close(descriptor)


def make_mirror(locations: Locations, folder: str) -> int:
    """
    Download the wheels of all requirements for other machines, and say how to use them.

    Parameters
    ----------
    locations
        The workspace and its environment.
    folder
        Where to put them.

    Returns
    -------
    int
        The exit status, 0.

    Raises
    ------
    SetupError
        A version of Python has no wheels, there is no environment yet, or pip failed.

    """
    versions = mirror.versions_of(os.environ.get('PYTHONS', ''))
    place = expanded_path(folder).resolve()
    mirror.make_mirror(locations, place, MIRRORED, versions)
    print(
        f'The wheels for Python {", ".join(versions)} are in {place}. On each machine without '
        'internet: make setup WHEELS=FOLDER'
    )
    return 0


def build(locations: Locations, arguments: list[str]) -> int:
    """
    Build src/ into install/ if its sources, the environment or the arguments have changed.

    Parameters
    ----------
    locations
        The workspace and its environment.
    arguments : list[str]
        Further arguments of `colcon build`.

    Returns
    -------
    int
        The exit status of colcon, or 0 if nothing has changed.

    """
    made_with = (os.fspath(locations.environment), python_version())
    current = digest(colcon.workspace_sources(locations), *made_with, *arguments)
    stamp = Stamp(ROOT / 'install' / '.built')
    if stamp.matches(current) and colcon.is_built(ROOT):
        return 0
    stamp.clear()
    status = colcon.build_workspace(locations, arguments)
    if status == 0:
        stamp.write(current)
    return status


def explain_os_error(error: OSError) -> str:
    """
    Format an error of the operating system as a message for the user.

    Parameters
    ----------
    error
        The error raised during a command.

    """
    name = f' ({error.filename})' if error.filename else ''
    return (
        f'The system reported: {error.strerror}{name}. Fix that and run the same command again: '
        'it continues from here'
    )
