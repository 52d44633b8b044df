# SPDX-License-Identifier: Apache-2.0
"""Check that installed scripts run with the Python that has the wheels."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
import os
from pathlib import Path
import shlex
import shutil

from ros2doctor.api.extension import DoctorCheck, DoctorReport, Finding, Report, Result, Severity
from ros2doctor.check.wheels import environment_prefix, install_command, is_own
from ros_environment.suggestions import listing

LONGEST_LINE = 512
INSTALL = 'install'


@dataclass(frozen=True)
class Script:
    """
    Program with a shebang line.

    :param is_fixed: whether the interpreter is named by its path, and not looked up in PATH
    :param exists: whether there is such an interpreter
    :param is_python: whether it is a Python
    :param is_own: whether it is that of this environment
    :param workspace: the folder in which colcon has installed the program, if it has
    """

    path: str
    interpreter: str
    is_fixed: bool
    exists: bool
    is_python: bool
    is_own: bool
    workspace: Path | None = None


def read_scripts() -> list[Script]:
    """Return the scripts among the executables of all packages, and the commands themselves."""
    return [script for path in _paths() if (script := read_script(path))]


def read_script(path: Path) -> Script | None:
    """
    Read the interpreter of a script from its shebang line (`#!`).

    Parameters
    ----------
    path
        The path of a file, which need not exist.

    Returns
    -------
    Script or None
        None if the file cannot be read or is not a script.

    """
    try:
        with path.open('rb') as stream:
            line = os.fsdecode(stream.readline(LONGEST_LINE)).strip()
    except OSError:
        return None
    words = line[2:].split() if line.startswith('#!') else []
    if not words:
        return None
    is_fixed = os.path.basename(words[0]) != 'env'
    program = words[0] if is_fixed else shutil.which(words[-1]) or words[-1]
    return Script(
        path=str(path),
        interpreter=program,
        is_fixed=is_fixed,
        exists=os.path.exists(program),
        is_python=os.path.basename(program).startswith('python'),
        is_own=is_own(program),
        workspace=_workspace(path),
    )


def _workspace(path: Path) -> Path | None:
    """Return the workspace whose install folder contains a program."""
    return next((each.parent for each in path.parents if each.name == INSTALL), None)


def _paths() -> Iterator[Path]:
    from ros2pkg.api import get_executable_paths, get_package_names
    from ros_environment.installed import prefixes

    for name in ('ros2', 'colcon', 'pytest'):
        yield Path(environment_prefix(), 'bin', name)
    for package in get_package_names() if prefixes() else ():
        yield from map(Path, get_executable_paths(package_name=package))


class ScriptsCheck(DoctorCheck):
    """Check of the interpreters of installed scripts."""

    def category(self) -> str:
        """Return the category."""
        return 'scripts'

    def check(self) -> Result:
        """Check for installed scripts with a wrong interpreter."""
        return Result(script_findings(read_scripts(), mending_command))


def script_findings(
    scripts: Iterable[Script], mend: Callable[[Path | None], str]
) -> Iterator[Finding]:
    """
    Report installed scripts whose interpreter does not exist, or is another Python.

    Scripts that look their interpreter up in PATH, by `env`, are ignored.

    Parameters
    ----------
    scripts
        The scripts to examine.
    mend
        Returns the command that reinstalls the scripts of a workspace, or those of the environment
        for None; see `mending_command`.

    Yields
    ------
    Finding
        One error for each wrong interpreter and workspace, which lists the scripts.

    """
    wrong: dict[tuple[str, Path | None], list[Script]] = defaultdict(list)
    for script in scripts:
        is_wrong = not script.exists or (script.is_python and not script.is_own)
        if is_wrong and script.is_fixed:
            wrong[script.interpreter, script.workspace].append(script)
    for (interpreter, workspace), found in wrong.items():
        yield _finding(interpreter, found, mend(workspace))


def mending_command(workspace: Path | None) -> str:
    """
    Build the command that reinstalls the scripts of a workspace or of the environment.

    Parameters
    ----------
    workspace
        The folder of the workspace, which is built from scratch; None for the environment.

    Returns
    -------
    str
        A command for the shell.

    """
    if workspace is None:
        return install_command()
    environment = shlex.quote(f'{environment_prefix()}/setup.bash')
    return (
        f'cd {shlex.quote(str(workspace))} && rm -rf build install && source {environment} && '
        'colcon build && source install/setup.bash'
    )


def _finding(interpreter: str, scripts: list[Script], mend: str) -> Finding:
    names = listing([script.path for script in scripts])
    if not scripts[0].exists:
        return Finding(
            Severity.ERROR,
            f"the interpreter '{interpreter}' does not exist, but is named by: {names}",
            'these programs cannot start: the environment that they were built with has been '
            'moved or deleted',
            mend,
        )
    return Finding(
        Severity.ERROR,
        f"'{interpreter}' is not the Python of this environment, but runs: {names}",
        'that Python does not have the wheels, so these programs end with an ImportError',
        mend,
    )


class ScriptsReport(DoctorReport):
    """Report of the number of scripts per interpreter."""

    def category(self) -> str:
        """Return the category."""
        return 'scripts'

    def report(self) -> Report:
        """Return the section."""
        report = Report('INTERPRETERS OF INSTALLED SCRIPTS')
        counts = Counter(script.interpreter for script in read_scripts())
        for interpreter, count in sorted(counts.items()):
            report.add_to_report(interpreter, f'{count} scripts')
        return report
