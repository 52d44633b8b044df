# SPDX-License-Identifier: Apache-2.0
"""What is installed and sourced, such as packages and executables, and the commands for it."""

from __future__ import annotations

from collections.abc import Iterator
import os
from pathlib import Path
import shlex

LAUNCH_SUFFIXES = ('launch.py', 'launch.xml', 'launch.yaml', 'launch.yml', '.launch')


def prefixes(variable: str = 'AMENT_PREFIX_PATH') -> list[Path]:
    """
    List the existing folders in an environment variable.

    Parameters
    ----------
    variable
        The name of the variable, such as AMENT_PREFIX_PATH or COLCON_PREFIX_PATH.

    """
    folders = (Path(text) for text in os.environ.get(variable, '').split(os.pathsep) if text)
    return [folder for folder in folders if folder.is_dir()]


def known_packages() -> set[str]:
    """Return the names of all packages that the environment makes available."""
    names: set[str] = set()
    for prefix in prefixes():
        index = prefix / 'share' / 'ament_index' / 'resource_index' / 'packages'
        if index.is_dir():
            names.update(os.listdir(index))
    return names


def built_on_demand(package: str) -> str:
    """
    Find the notice on a package that is only built on demand.

    Parameters
    ----------
    package
        The name of the package.

    Returns
    -------
    str
        What an installed package says of it in the resource index `on_demand`; '' if nothing.

    """
    for prefix in prefixes():
        index = prefix / 'share' / 'ament_index' / 'resource_index' / 'on_demand'
        for path in sorted(index.glob('*')):
            words, _, sentence = path.read_text(encoding='utf-8').partition('\n')
            if any(word in package for word in words.split()):
                return sentence.strip()
    return ''


def is_installed_in(install: Path, package: str) -> bool:
    """
    Check whether a package is installed in a workspace, in a merged or an isolated layout.

    Parameters
    ----------
    install
        The install folder of the workspace.
    package
        The name of the package.

    """
    marker = Path('share', 'ament_index', 'resource_index', 'packages', package)
    return (install / package / marker).exists() or (install / marker).exists()


def executables(prefix: Path, package: str) -> list[str]:
    """
    List the names of a package's executables, sorted.

    Parameters
    ----------
    prefix
        The install prefix of the package.
    package
        The name of the package.

    """
    folder = prefix / 'lib' / package
    return sorted(path.name for path in _files(folder) if os.access(path, os.X_OK))


def launch_files(share: Path) -> list[str]:
    """
    List the names of the launch files of a package, sorted.

    Parameters
    ----------
    share
        The share folder of the package.

    """
    return sorted(path.name for path in _files(share) if path.name.endswith(LAUNCH_SUFFIXES))


def package_of_share_file(path: Path) -> str | None:
    """
    Find the package in whose share folder a path lies.

    Parameters
    ----------
    path
        The path, which need not exist.

    Returns
    -------
    str or None
        None if it lies in the share folder of no known prefix.

    """
    for prefix in prefixes():
        share = prefix / 'share'
        if share in path.parents:
            return path.relative_to(share).parts[0]
    return None


def current_folder() -> Path:
    """Return the current folder, or where it was if it has been deleted."""
    try:
        return Path.cwd()
    except FileNotFoundError:
        return Path(os.environ.get('PWD') or '/')


def source_command(workspace: Path) -> str:
    """
    Format the shell command that sources a built workspace.

    Parameters
    ----------
    workspace
        The folder of the workspace; the path is relative if it is the current folder.

    """
    return f'source {_reach(workspace, "install/setup.bash")}'


def build_command(workspace: Path, package: str) -> str:
    """
    Format the shell commands that build one package and source its workspace.

    Parameters
    ----------
    workspace
        The folder of the workspace.
    package
        The package that is built.

    """
    build = f'colcon build --packages-select {package}'
    if current_folder() != workspace:
        build = f'cd {shlex.quote(str(workspace))} && {build}'
    return f'{build} && source install/setup.bash'


def _files(folder: Path) -> Iterator[Path]:
    for root, folders, names in os.walk(folder):
        folders[:] = [name for name in folders if not name.startswith('.')]
        yield from (Path(root, name) for name in names)


def _reach(workspace: Path, relative: str) -> str:
    return relative if current_folder() == workspace else shlex.quote(str(workspace / relative))
