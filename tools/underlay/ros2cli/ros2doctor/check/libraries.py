# SPDX-License-Identifier: Apache-2.0
"""Check that the dynamic linker finds the libraries of the wheels, and no others."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
import os
from pathlib import Path

from ros2doctor.api.extension import DoctorCheck, DoctorReport, Finding, Report, Result, Severity
from ros2doctor.check.environment import set_up_command
from ros2doctor.check.wheels import environment_prefix

MIDDLEWARE_LIBRARIES = ('librcl.so', 'librmw.so', 'libfastrtps.so', 'libfastcdr.so')
SYSTEM_LIBRARIES = ('libstdc++.so.6', 'libssl.so.3', 'libz.so.1')


@dataclass(frozen=True)
class LibraryFolder:
    """
    A folder of LD_LIBRARY_PATH.

    :param has_ros: whether it contains libraries of ROS
    :param system_libraries: system libraries that it shadows
    """

    path: str
    has_ros: bool
    system_libraries: tuple[str, ...]


@dataclass(frozen=True)
class Libraries:
    """
    Search path of libraries.

    :param own: the folder with the libraries of the wheels
    :param search: the folders of LD_LIBRARY_PATH in their order
    :param set_by_shell: whether Python relies on the shell for the path
    """

    own: str
    search: tuple[LibraryFolder, ...]
    set_by_shell: bool


def read_libraries() -> Libraries:
    """Return the library path of this process."""
    texts = os.environ.get('LD_LIBRARY_PATH', '').split(os.pathsep)
    return Libraries(
        own=os.path.join(environment_prefix(), 'lib'),
        search=tuple(_read_folder(Path(text)) for text in texts if text),
        set_by_shell=os.environ.get('_ROS_WHEELS_BOOTSTRAP_COMPLETE') == '1',
    )


def _read_folder(path: Path) -> LibraryFolder:
    return LibraryFolder(
        path=str(path),
        has_ros=any((path / name).exists() for name in MIDDLEWARE_LIBRARIES),
        system_libraries=tuple(name for name in SYSTEM_LIBRARIES if (path / name).exists()),
    )


class LibrariesCheck(DoctorCheck):
    """Check of LD_LIBRARY_PATH."""

    def category(self) -> str:
        """Return the category."""
        return 'libraries'

    def check(self) -> Result:
        """Check the library path of this process."""
        return Result(library_findings(read_libraries(), set_up_command()))


def library_findings(facts: Libraries, set_up: str) -> Iterator[Finding]:
    """
    Report problems of LD_LIBRARY_PATH.

    Parameters
    ----------
    facts
        The folders of the path, as `read_libraries` gives them.
    set_up
        The command that sets up a new terminal, which findings suggest.

    Yields
    ------
    Finding
        An error if libraries of the wheels are not found, or those of another ROS take precedence;
        a warning if a folder shadows system libraries.

    """
    names = [os.path.realpath(folder.path) for folder in facts.search]
    own = os.path.realpath(facts.own)
    if facts.set_by_shell and own not in names:
        yield Finding(
            Severity.ERROR,
            f"LD_LIBRARY_PATH does not name '{facts.own}'",
            'the libraries of the wheels are not found, so `import rclpy` fails',
            f'open a new terminal and run: {set_up}',
        )
    earlier = facts.search[: names.index(own)] if own in names else facts.search
    for folder, name in zip(facts.search, names):
        if folder.has_ros and folder in earlier and name != own:
            yield Finding(
                Severity.ERROR,
                f"LD_LIBRARY_PATH names '{folder.path}' first, which has libraries of another ROS",
                'they are loaded instead of those of the wheels, which crashes or fails to load',
                f'{_without(folder.path)}, or open a new terminal and run: {set_up}',
            )
        if folder.system_libraries and name != own:
            yield Finding(
                Severity.WARNING,
                f"LD_LIBRARY_PATH names '{folder.path}', which has its own "
                f'{", ".join(folder.system_libraries)}',
                'programs of the system and the wheels may not be compatible with these (conda '
                'does this, for example)',
                _without(folder.path),
            )


def _without(folder: str) -> str:
    return f"remove '{folder}' from LD_LIBRARY_PATH (in ~/.bashrc, or: conda deactivate)"


class LibrariesReport(DoctorReport):
    """Report of the library folders."""

    def category(self) -> str:
        """Return the category."""
        return 'libraries'

    def report(self) -> Report:
        """Return the section."""
        facts = read_libraries()
        report = Report('LIBRARIES')
        report.add_to_report('of the wheels', facts.own)
        for folder in facts.search:
            ros = ['ROS'] if folder.has_ros else []
            contents = ', '.join([*ros, *folder.system_libraries])
            report.add_to_report('searched', f'{folder.path} ({contents})'.replace(' ()', ''))
        return report
