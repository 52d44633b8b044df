# SPDX-License-Identifier: Apache-2.0
"""The wheels that requirements files pin: installation, repair and patches."""

from __future__ import annotations

from collections.abc import Iterator
import csv
from pathlib import Path
import re

from console import SetupError, Steps
from fast_dds import mend_fast_dds
from locations import Locations
from mend import is_mended, mend_wheels
from processes import environment_variables, last_words, run_logged, run_or_fail

PIP = ('-m', 'pip', '--disable-pip-version-check', '--no-input')


def make_environment(locations: Locations, interpreter: str) -> None:
    """
    Create the virtual environment, or complete one whose creation was interrupted.

    Parameters
    ----------
    locations
        The workspace and its environment.
    interpreter
        The Python that the environment is to use.

    Raises
    ------
    SetupError
        The module venv failed.

    """
    run_or_fail(
        [interpreter, '-m', 'venv', locations.environment],
        cwd=locations.root,
        failure=f'The virtual environment {locations.environment} cannot be created',
    )


def has_pip(locations: Locations) -> bool:
    """
    Whether the environment is complete, including pip, which is installed last.

    Parameters
    ----------
    locations
        The workspace and its environment, which need not exist yet.

    """
    folders = locations.environment.glob('lib/python3.*/site-packages/pip-*.dist-info/RECORD')
    return locations.python.exists() and any(folders)


def site_packages(locations: Locations) -> Path:
    """
    Return the environment's folder of Python packages.

    Parameters
    ----------
    locations
        The workspace and its environment, which has to exist.

    """
    return next(iter(sorted(locations.environment.glob('lib/python3.*/site-packages'))))


def pinned_names(requirements: str) -> list[str]:
    """
    Extract the names of the distributions that a requirements file pins.

    Parameters
    ----------
    requirements
        The text of the file.

    """
    return re.findall(r'^([A-Za-z0-9._-]+)==', requirements, flags=re.MULTILINE)


def install_wheels(locations: Locations, steps: Steps, include: str, requirements: Path) -> None:
    """
    Install the wheels that a file pins, repair incomplete ones, and mend them all.

    Parameters
    ----------
    locations
        The workspace and its environment.
    steps
        Shows the progress.
    include
        The folder with Python.h.
    requirements
        The file that pins them.

    Raises
    ------
    SetupError
        pip failed, or the Fast DDS library is not the build that can be mended.
    FileNotFoundError
        A wheel lacks a file that was to be mended.

    """
    fetch_wheels(locations, steps, requirements)
    mend_wheels(locations.environment, include, site_packages(locations))
    mend_fast_dds(locations.environment)


def fetch_wheels(locations: Locations, steps: Steps, requirements: Path) -> None:
    """
    Install the wheels that a file pins, and repair incomplete ones.

    Parameters
    ----------
    locations
        The workspace and its environment.
    steps
        Shows the progress.
    requirements
        The file that pins them.

    Raises
    ------
    SetupError
        pip failed.

    """
    count = len(pinned_names(requirements.read_text(encoding='utf-8')))
    _pip(locations, steps, count, '--no-deps', '--requirement', str(requirements))
    broken = sorted(incomplete_distributions(site_packages(locations), locations.environment))
    if broken:
        steps.note(f'repairing {len(broken)} wheels that an interruption left incomplete')
        arguments = ['--no-deps', '--ignore-installed', *broken]
        _pip(locations, steps, len(broken), *arguments)


def _pip(locations: Locations, steps: Steps, count: int, *arguments: str) -> None:
    log = locations.environment / 'log' / 'pip.log'
    seen = 0

    def show(line: str) -> None:
        nonlocal seen
        if line.startswith(('Collecting ', 'Requirement already satisfied: ')):
            seen += 1
            name = re.split(r'[=<>~!\[; (]', line.split(': ')[-1].replace('Collecting ', ''))[0]
            steps.progress(f'{min(seen, count)} of {count}: {name}')
        elif line.startswith('Installing collected packages'):
            steps.progress(f'{count} of {count} fetched; unpacking them')

    status = run_logged(
        [locations.python, *PIP, 'install', '--no-compile', '--progress-bar', 'off', *arguments],
        cwd=locations.root,
        variables=environment_variables(locations.environment),
        log=log,
        each_line=show,
    )
    if status != 0:
        raise SetupError(
            f'pip could not install the wheels (the full output is in {log}):\n'
            f'{last_words(log, "ERROR")}\n'
            'Fix that (network, proxy, disk) and run the same command again: it continues there, '
            'and what was already downloaded stays in the cache of pip'
        )


def compile_all(locations: Locations) -> None:
    """
    Compile every module, in parallel; modules that do not compile are never imported.

    pip could do so too, but sequentially, and most are not used by the robot: until then Python
    compiles a module when it is first imported.

    Parameters
    ----------
    locations
        The workspace and its environment.

    """
    packages = site_packages(locations)
    command = [str(locations.python), '-m', 'compileall', '-q', '-j', '0', str(packages)]
    run_logged(
        command,
        cwd=locations.root,
        variables=environment_variables(locations.environment),
        log=locations.environment / 'log' / 'compileall.log',
    )


def incomplete_distributions(packages: Path, environment: Path) -> Iterator[str]:
    """
    Find the distributions whose files are missing or differ in size from their RECORD.

    Parameters
    ----------
    packages
        The folder of Python packages.
    environment
        The environment that it belongs to.

    Yields
    ------
    str
        `name==version` of each.

    """
    for info in packages.glob('*.dist-info'):
        name, _, version = info.name[: -len('.dist-info')].rpartition('-')
        if name != 'pip' and not _is_complete(info, environment):
            yield f'{name}=={version}'


def _is_complete(info: Path, environment: Path) -> bool:
    record = info / 'RECORD'
    if not record.is_file():
        return False
    with record.open(newline='', encoding='utf-8') as lines:
        rows = [row for row in csv.reader(lines) if row]
    return all(_is_whole(info.parent / row[0], row[2], environment) for row in rows)


def _is_whole(path: Path, recorded_size: str, environment: Path) -> bool:
    if path.suffix == '.pyc':  # Python rewrites these
        return True
    try:
        size = path.stat().st_size
    except OSError:
        return False
    return not recorded_size or size == int(recorded_size) or is_mended(environment, path)
