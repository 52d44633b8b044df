# SPDX-License-Identifier: Apache-2.0
"""The commands of the set-up: setup, mirror, build, prepare, tests, site, clean, distclean."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
import fcntl
import os
from pathlib import Path
import shutil
import signal
import sys
import sysconfig

import colcon
from console import SetupError, Steps
from locations import find_locations, link_environment, Locations
import mirror
from ownership import Home, python_version
from parts import Parts
import prerequisites
import processes
from stamp import digest, Stamp
from underlay import Underlay
import wheels

ROOT = Path(__file__).resolve().parents[2]
BUILT = ('build', 'install', 'log', 'site')
REQUIREMENTS = ROOT / 'requirements.txt'
PART_REQUIREMENTS = ROOT / 'requirements-parts.txt'
TEST_REQUIREMENTS = ROOT / 'requirements-test.txt'
SITE_REQUIREMENTS = ROOT / 'requirements-site.txt'
MIRRORED = (REQUIREMENTS, PART_REQUIREMENTS, TEST_REQUIREMENTS)
"""What `make mirror` collects: everything but the generator of the site."""
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
    commands = ['setup', 'mirror', 'build', 'prepare', 'tests', 'site', 'clean', 'distclean']
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
        One of `setup`, `build`, `prepare`, `tests`, `site`, `clean` and `distclean`.
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
        return set_up(locations)
    if command == 'build':
        return set_up(locations, quiet=True) or build(locations, arguments)
    if command == 'prepare':
        return set_up(locations, quiet=True, everything=False) or build(locations, [])
    if command == 'tests':
        return set_up(locations, quiet=True) or set_up_tests(locations)
    if command == 'site':
        return build_site(locations)
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


def set_up(locations: Locations, *, quiet: bool = False, everything: bool = True) -> int:
    """
    Bring the environment up to date with this workspace; quick if it already is.

    Parameters
    ----------
    locations
        The workspace and its environment.
    quiet
        Print nothing if the environment is complete, and no hint at the end.
    everything
        Install everything; otherwise defer what the command does not need: interface packages that
        nothing in src/ depends on, and packages on demand and wheels of parts that ASKED_FOR does
        not name.

    Returns
    -------
    int
        The exit status, 0.

    Raises
    ------
    SetupError
        The machine lacks something, a step failed, or another workspace owns the environment.

    """
    requirements = wheels_digest(REQUIREMENTS)
    wheels_stamp = Stamp(locations.environment / 'stamp' / 'wheels')
    asked_for = os.environ.get('ASKED_FOR', '')
    underlay = Underlay(locations, requirements, asked_for)
    parts = Parts(locations, PART_REQUIREMENTS, asked_for)
    home = Home(locations)
    home.require_same()
    stale = underlay.to_build(everything=everything)
    missing = parts.to_install(everything=everything)
    compiled = wheels_digest(REQUIREMENTS, PART_REQUIREMENTS)
    compiled_stamp = Stamp(locations.environment / 'stamp' / 'compiled')
    is_compiled = not everything or compiled_stamp.matches(compiled)
    has_wheels = wheels_stamp.matches(requirements)
    if locations.link.exists() and has_wheels and is_compiled and not missing and not stale:
        link_environment(locations)
        underlay.describe_others()
        parts.describe_others()
        if not quiet:
            print(f'The environment in {locations.link} is complete.')
        return 0
    require_machine(locations, has_wheels=has_wheels)
    steps = Steps(3)
    steps.begin(f'Python {python_version()} environment in {locations.environment}')
    locations.environment.mkdir(parents=True, exist_ok=True)
    home.write()
    link_environment(locations)
    if not wheels.has_pip(locations):
        wheels.make_environment(locations, sys.executable)
    steps.begin('Wheels from PyPI, as requirements.txt and requirements-parts.txt pin them')
    if not has_wheels:
        wheels_stamp.clear()
        wheels.install_wheels(locations, steps, sysconfig.get_path('include'), REQUIREMENTS)
        wheels_stamp.write(requirements)
    parts.install(missing, steps)
    parts.describe_others()
    if not is_compiled:
        wheels.compile_all(locations)
        compiled_stamp.write(compiled)
    steps.begin('Underlay: launch, ros2 and what else PyPI lacks (a minute)')
    underlay.build(stale, steps)
    underlay.describe_others()
    steps.end()
    print('The environment is complete.' + ('' if quiet else ' Next: make bringup'))
    return 0


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
    place = Path(folder).expanduser().resolve()
    mirror.make_mirror(locations, place, MIRRORED, versions)
    print(
        f'The wheels for Python {", ".join(versions)} are in {place}. On each machine without '
        'internet: make setup WHEELS=FOLDER'
    )
    return 0


def set_up_tests(locations: Locations) -> int:
    """
    Install the wheels of requirements-test.txt, which only tests need.

    Parameters
    ----------
    locations
        The workspace and its environment, which is complete except for them.

    Returns
    -------
    int
        The exit status, 0.

    """
    current = wheels_digest(REQUIREMENTS, TEST_REQUIREMENTS)
    stamp = Stamp(locations.environment / 'stamp' / 'tests')
    if not stamp.matches(current):
        steps = Steps(1)
        steps.begin('Libraries that tests compare ours with')
        stamp.clear()
        include = sysconfig.get_path('include')
        wheels.install_wheels(locations, steps, include, TEST_REQUIREMENTS)
        wheels.compile_all(locations)
        stamp.write(current)
        steps.end()
    return 0


def build_site(locations: Locations) -> int:
    """
    Build the documentation as a site, in an environment of its own, which needs no compiler.

    Parameters
    ----------
    locations
        The workspace and its environment, which need not exist yet: that of the site is in it.

    Returns
    -------
    int
        The exit status of the build.

    Raises
    ------
    SetupError
        A wheel could not be installed, or another workspace owns the environment.

    """
    home = Home(locations)
    home.require_same()
    folder = locations.environment / 'site'
    own = Locations(locations.root, folder, folder)
    current = digest([SITE_REQUIREMENTS])
    stamp = Stamp(folder / 'stamp')
    if not stamp.matches(current):
        steps = Steps(1)
        steps.begin('Sphinx and its theme from PyPI, as requirements-site.txt pins them')
        stamp.clear()
        folder.mkdir(parents=True, exist_ok=True)
        home.write()
        link_environment(locations)
        if not wheels.has_pip(own):
            wheels.make_environment(own, sys.executable)
        wheels.fetch_wheels(own, steps, SITE_REQUIREMENTS)
        stamp.write(current)
        steps.end()
    print('Building the site: about a minute', flush=True)
    return processes.run(
        [own.python, ROOT / 'tools' / 'site' / 'build.py'],
        cwd=locations.root,
        variables=processes.without_inherited(),
    )


def wheels_digest(*requirements: Path) -> str:
    """
    Compute the digest of the pinned wheels, and of the patches to them.

    Parameters
    ----------
    *requirements
        The requirements files that pin the wheels.

    Returns
    -------
    str
        A SHA-256 digest in hexadecimal.

    """
    mends = [ROOT / 'tools' / 'setup' / name for name in ('mend.py', 'fast_dds.py')]
    return digest([*requirements, *mends])


def require_machine(locations: Locations, *, has_wheels: bool) -> None:
    """
    Check that the machine meets all requirements, before anything is downloaded.

    Parameters
    ----------
    locations
        The workspace and its environment.
    has_wheels
        Whether the wheels are installed already, so that less disk space is needed.

    Raises
    ------
    SetupError
        Something is missing; the message lists all of it.

    """
    root, environment = os.fspath(locations.root), os.fspath(locations.environment)
    missing = prerequisites.problems(root, environment, has_wheels=has_wheels)
    if missing:
        raise SetupError('\n'.join(missing))


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


def remove(paths: Iterator[Path]) -> None:
    """
    Delete folders, if they exist.

    Parameters
    ----------
    paths
        The folders; files are left alone.

    """
    for path in paths:
        if path.is_dir():
            shutil.rmtree(path)


def refuse_what_belongs_to_others(locations: Locations) -> None:
    """
    Check that no other workspace owns an environment that is to be deleted.

    Parameters
    ----------
    locations
        The workspace and its environment.

    Raises
    ------
    SetupError
        It belongs to another workspace, and .venv is not a link to it.

    """
    other = Home(locations).other_workspace()
    if other and not locations.is_linked:
        raise SetupError(
            f'The environment in {locations.environment} belongs to the workspace in {other}: '
            'run `make distclean` there, or here without VENV'
        )


def forget_environment(locations: Locations) -> None:
    """
    Delete the environment if the set-up placed it; if the user named it, only the link.

    Parameters
    ----------
    locations
        The workspace and its environment.

    """
    if Home(locations).is_deleted_with_the_workspace():
        remove(iter([locations.environment]))
    else:
        print(f'The environment in {locations.environment} was chosen by you and is kept.')
    if locations.link.is_symlink():
        locations.link.unlink()


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
