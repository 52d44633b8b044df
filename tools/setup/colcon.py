# SPDX-License-Identifier: Apache-2.0
"""Builds with colcon: the underlay into the environment, and the workspace into install/."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
import os
from pathlib import Path

from console import SetupError, Steps
from locations import Locations
from packages import Package, read_packages
from processes import environment_variables, last_words, run, run_logged, without_inherited
from stamp import files_below

FIRST = 'ros_environment'


def build_underlay(
    locations: Locations,
    steps: Steps,
    names: list[str],
    waiting: list[str],
    finished: Callable[[str], None],
) -> None:
    """
    Build packages of tools/underlay into the environment, which thereby gets its setup.bash.

    ros_environment is built first: once the environment has set-up files, it can be used as the
    prefix in which the other packages find their dependencies.

    Parameters
    ----------
    locations
        The workspace and its environment.
    steps
        Shows which packages are being built.
    names
        Packages to build.
    waiting
        Packages that are neither built nor to be built now. colcon would look for their installed
        files, as others depend on them for their tests.
    finished
        Called with the name of each package as soon as it is built.

    Raises
    ------
    SetupError
        The build failed; the message quotes the errors and names the log.

    """
    variables = environment_variables(locations.environment)
    if FIRST in names:
        _build_underlay(locations, steps, variables, [FIRST], waiting, finished)
    others = [name for name in names if name != FIRST]
    variables['AMENT_PREFIX_PATH'] = str(locations.environment)
    if others:
        _build_underlay(locations, steps, variables, others, waiting, finished)


def _build_underlay(
    locations: Locations,
    steps: Steps,
    variables: dict[str, str],
    names: list[str],
    waiting: list[str],
    finished: Callable[[str], None],
) -> None:
    log = locations.environment / 'log' / 'underlay.log'

    building: list[str] = []

    def show(line: str) -> None:
        if line.startswith('Starting >>> '):
            building.append(line.split()[2])
        elif line.startswith('Finished <<< ') and line.split()[2] in building:
            building.remove(line.split()[2])
            finished(line.split()[2])
        if building:
            steps.progress(f'building {" and ".join(building)}')

    build = locations.environment / 'build'
    command: list[str | Path] = [locations.environment / 'bin' / 'colcon']
    command += ['--log-base', build / 'log', 'build', '--build-base', build]
    command += ['--base-paths', locations.underlay, '--packages-select', *names]
    command += ['--packages-ignore', *waiting] if waiting else []
    command += ['--merge-install', '--install-base', locations.environment]
    status = run_logged(
        command,
        cwd=locations.root,
        variables=variables,
        log=log,
        each_line=show,
    )
    if status != 0:
        raise SetupError(
            f'The underlay could not be built (the full output of colcon is in {log}):\n'
            f'{last_words(log, "rror", 5)}\nFix that and run the same command again'
        )


def remove_outdated_modules(packages: Iterable[Package], build_base: Path) -> None:
    """
    Remove the built and installed copies of Python modules that their packages no longer have.

    setuptools copies modules and leaves those of an earlier build where they are: they could still
    be imported, and a folder that has become a module would hide it.

    Parameters
    ----------
    packages
        Packages that are built next.
    build_base
        The folder that colcon builds in.

    """
    for package in packages:
        copies = build_base / package.name / 'build' / 'lib'
        modules = [path.relative_to(copies) for path in copies.rglob('*.py')]
        outdated = [each for each in modules if not (package.folder / each).exists()]
        record = build_base / package.name / 'install.log'
        installed = record.read_text().splitlines() if outdated and record.exists() else []
        for module in outdated:
            found = [Path(line) for line in installed if line.endswith(f'{os.sep}{module}')]
            for path in [copies / module, *found]:
                _remove_module(path)


def _remove_module(path: Path) -> None:
    """Remove a Python file, its bytecode, and the folders that are empty without them."""
    path.unlink(missing_ok=True)
    for compiled in path.parent.glob(f'__pycache__/{path.stem}.*.pyc'):
        compiled.unlink()
    with suppress(OSError):  # raised by the first folder that is not empty
        for folder in (path.parent / '__pycache__', *path.parents):
            if folder.exists():
                folder.rmdir()


def workspace_sources(locations: Locations) -> Iterator[str]:
    """
    List the files that install/ is built from.

    Parameters
    ----------
    locations
        The workspace.

    Yields
    ------
    str
        The path of each file below src/, without caches and tests, and that of colcon.meta.

    """
    yield from files_below(locations.root / 'src')
    yield str(locations.root / 'colcon.meta')


def build_workspace(locations: Locations, arguments: list[str]) -> int:
    """
    Run `colcon build` as a user would in the sourced environment; return its exit status.

    A build of all packages first removes modules that they no longer have. One with arguments,
    which may select packages, does not: a module removed by mistake, such as a generated one,
    would not be built again.

    Parameters
    ----------
    locations
        The workspace to build.
    arguments : list[str]
        Further arguments of `colcon build`.

    """
    if not arguments:
        packages = read_packages(locations.root / 'src').values()
        remove_outdated_modules(packages, locations.root / 'build')
    runner = os.fspath(locations.root / 'tools' / 'in_environment')
    command = [runner, '--underlay', 'colcon', 'build', *arguments]
    return run(command, cwd=locations.root, variables=without_inherited())


def is_built(root: Path) -> bool:
    """
    Whether a workspace has an install/setup.bash to source.

    Parameters
    ----------
    root
        The folder of the workspace.

    """
    return (root / 'install' / 'setup.bash').is_file()
