# SPDX-License-Identifier: Apache-2.0
"""Check that the dynamic linker finds the libraries of the wheels, and no others."""

from __future__ import annotations

from collections.abc import Iterator
import os

from ros2doctor.api.extension import DoctorCheck
from ros2doctor.api.finding import Finding, Result, Severity
from ros2doctor.facts.environment import set_up_command
from ros2doctor.facts.libraries import Libraries, read_libraries


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
                'programs of the system and the wheels may not fit these (conda does this, for '
                'example)',
                _without(folder.path),
            )


def _without(folder: str) -> str:
    return f"take '{folder}' out of LD_LIBRARY_PATH (in ~/.bashrc, or: conda deactivate)"
