# SPDX-License-Identifier: Apache-2.0
"""The packages of the relevant workspaces: in the source tree, built, and known to the shell."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
import filecmp
import os
from pathlib import Path

from ros_environment.advice import current_folder
from ros_environment.installed import is_installed_in, known_packages
from ros_environment.source_tree import source_packages, SourcePackage
from ros_environment.workspace import workspaces

NEVER_INSTALLED = ('test', 'tests', '__pycache__')
COMPILED = ('.c', '.cc', '.cpp', '.h', '.hpp', '.msg', '.srv', '.action', '.idl')
BUILD_FILES = ('CMakeLists.txt', 'package.xml', 'setup.py', 'setup.cfg')


@dataclass(frozen=True)
class PackageState:
    """
    A package of a source tree.

    :param is_built: whether the install folder has it
    :param is_known: whether this shell finds it
    :param changed: files that are newer than the build, and differ from their installed copies
    """

    name: str
    folder: Path
    is_built: bool
    is_known: bool
    changed: tuple[str, ...] = ()


@dataclass(frozen=True)
class Workspace:
    """
    A colcon workspace.

    :param is_current: whether the current folder is in it
    """

    folder: Path
    packages: tuple[PackageState, ...]
    is_current: bool


def read_workspaces() -> list[Workspace]:
    """Return the workspace that contains the current folder, and those that are sourced."""
    known = known_packages()
    return [_read_workspace(folder, known) for folder in workspaces()]


def _read_workspace(folder: Path, known: set[str]) -> Workspace:
    packages = source_packages(folder).values()
    return Workspace(
        folder,
        tuple(_read_package(folder / 'install', each, known) for each in packages),
        is_current=folder in (current_folder(), *current_folder().parents),
    )


def _read_package(install: Path, source: SourcePackage, known: set[str]) -> PackageState:
    prefix = install / source.name
    return PackageState(
        name=source.name,
        folder=source.folder,
        is_built=is_installed_in(install, source.name),
        is_known=source.name in known,
        changed=tuple(changed_files(source, prefix if prefix.is_dir() else install)),
    )


def changed_files(source: SourcePackage, prefix: Path) -> Iterator[str]:
    """
    List the source files of a package that were changed after it was built.

    A file that equals its installed copy does not count; one without a copy counts if it is part
    of the build, or if others of its kind are installed where its copy would be.

    Parameters
    ----------
    source
        The package in the source tree.
    prefix
        The install prefix, in which colcon marks the time of the build; without that mark,
        nothing is listed.

    Yields
    ------
    str
        The path of a file, relative to the folder of the package.

    """
    marker = prefix / 'share' / 'colcon-core' / 'packages' / source.name
    if not marker.is_file():
        return
    built_ns = marker.stat().st_mtime_ns
    copies = _folders_of_copies(prefix, source.name)
    for path in _source_files(source.folder):
        if path.stat().st_mtime_ns > built_ns:
            relative = path.relative_to(source.folder)
            if _differs(path, [folder / relative for folder in copies]):
                yield relative.as_posix()


def _folders_of_copies(prefix: Path, package: str) -> list[Path]:
    """Return the folders that files of a package are copied to; symlink installs have none."""
    modules = [path.parent for path in prefix.glob(f'lib/python3*/site-packages/{package}')]
    return [prefix / 'share' / package, *modules]


def _source_files(folder: Path) -> Iterator[Path]:
    for root, folders, names in os.walk(folder):
        folders[:] = [
            name for name in folders if name not in NEVER_INSTALLED and not name.startswith('.')
        ]
        yield from (Path(root, name) for name in names if Path(root, name).is_file())


def _differs(source: Path, copies: list[Path]) -> bool:
    """Whether a file differs from its installed copies, or lacks a copy that it should have."""
    existing = [copy for copy in copies if copy.is_file()]
    if not existing:
        return _is_built_from(source) or any(map(_has_siblings, copies))
    return not any(filecmp.cmp(source, copy, shallow=False) for copy in existing)


def _is_built_from(source: Path) -> bool:
    return source.suffix in COMPILED or source.name in BUILD_FILES


def _has_siblings(copy: Path) -> bool:
    """Whether files with the same suffix are installed where a copy would be."""
    return bool(copy.suffix) and any(copy.parent.glob(f'*{copy.suffix}'))
