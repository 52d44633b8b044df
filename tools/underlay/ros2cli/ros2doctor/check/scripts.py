# SPDX-License-Identifier: Apache-2.0
"""Check that installed scripts run with the Python that has the wheels."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
import shlex

from ros2doctor.api.extension import DoctorCheck
from ros2doctor.api.finding import Finding, Result, Severity
from ros2doctor.facts.prefix import environment_prefix
from ros2doctor.facts.scripts import read_scripts, Script
from ros2doctor.facts.wheels import install_command
from ros_environment.advice import listing


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
