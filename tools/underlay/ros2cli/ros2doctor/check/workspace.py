# SPDX-License-Identifier: Apache-2.0
"""Check that the workspace is built, sourced, and as new as its sources."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
import filecmp
import os
from pathlib import Path
import shlex

from ros2doctor.api.extension import DoctorCheck, DoctorReport, Finding, Report, Result, Severity
from ros_environment.installed import (
    build_command,
    current_folder,
    is_installed_in,
    known_packages,
    source_command,
)
from ros_environment.source_tree import source_packages, SourcePackage
from ros_environment.suggestions import listing
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


class WorkspaceCheck(DoctorCheck):
    """Check of the relevant workspaces."""

    def category(self) -> str:
        """Return the category."""
        return 'workspace'

    def check(self) -> Result:
        """Check for workspaces and packages that have to be built or sourced."""
        return Result(workspace_findings(read_workspaces()))


def workspace_findings(facts: Iterable[Workspace]) -> Iterator[Finding]:
    """
    Report workspaces and packages that have to be built or sourced.

    Parameters
    ----------
    facts
        The workspaces; those that neither are sourced nor contain the current folder are skipped.

    Yields
    ------
    Finding
        An error for a workspace that is not built or not sourced at all, else a warning for each
        package that is not built, not sourced, or older than its sources.

    """
    for workspace in filter(_is_used, facts):
        built = [package for package in workspace.packages if package.is_built]
        if not built:
            yield _not_built(workspace.folder)
            continue
        if not any(package.is_known for package in built):
            yield _not_sourced(workspace.folder)
            continue
        for package in workspace.packages:
            yield from _package_findings(workspace.folder, package)


def _is_used(workspace: Workspace) -> bool:
    """Whether a workspace contains the current folder or is sourced."""
    return workspace.is_current or any(package.is_known for package in workspace.packages)


def _package_findings(folder: Path, package: PackageState) -> Iterator[Finding]:
    if not package.is_built:
        yield Finding(
            Severity.WARNING,
            f"the package '{package.name}' in '{package.folder}' is not built",
            '`ros2 run` and `ros2 launch` do not find it',
            build_command(folder, package.name),
        )
    elif not package.is_known:
        yield Finding(
            Severity.WARNING,
            f"the package '{package.name}' was built after this terminal was set up",
            '`ros2 run` and `ros2 launch` do not find it here',
            source_command(folder),
        )
    elif package.changed:
        yield Finding(
            Severity.WARNING,
            f"'{package.name}' is older than its sources: {listing(list(package.changed))}",
            'what runs does not have these changes yet',
            build_command(folder, package.name),
        )


def _not_built(folder: Path) -> Finding:
    return Finding(
        Severity.ERROR,
        f"the workspace '{folder}' is not built",
        'none of its packages can be run or launched',
        f'cd {shlex.quote(str(folder))} && colcon build && source install/setup.bash',
    )


def _not_sourced(folder: Path) -> Finding:
    return Finding(
        Severity.ERROR,
        f"the workspace '{folder}' is built, but not sourced in this terminal",
        '`ros2 run` and `ros2 launch` do not find its packages',
        source_command(folder),
    )


class WorkspaceReport(DoctorReport):
    """Report of built and sourced packages."""

    def category(self) -> str:
        """Return the category."""
        return 'workspace'

    def report(self) -> Report:
        """Return the section."""
        report = Report('WORKSPACES')
        for workspace in read_workspaces():
            report.add_to_report('folder', workspace.folder)
            for package in workspace.packages:
                report.add_to_report(package.name, _state(package))
        return report


def _state(package: PackageState) -> str:
    words = [
        'built' if package.is_built else 'not built',
        'known to this terminal' if package.is_known else 'not known to this terminal',
    ]
    if package.changed:
        words.append(f'{len(package.changed)} files changed since')
    return ', '.join(words)
