# SPDX-License-Identifier: Apache-2.0
"""Check that installed scripts run with the Python that has the wheels."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator

from ros2doctor.api.extension import DoctorCheck
from ros2doctor.api.finding import Finding, Result, Severity
from ros2doctor.facts.environment import set_up_command
from ros2doctor.facts.scripts import read_scripts, Script
from ros_environment.advice import listing


class ScriptsCheck(DoctorCheck):
    """The check of the interpreters of installed scripts."""

    def category(self) -> str:
        """Return the name."""
        return 'scripts'

    def check(self) -> Result:
        """Return which installed scripts run with a wrong interpreter."""
        return Result(script_findings(read_scripts(), set_up_command()))


def script_findings(scripts: Iterable[Script], set_up: str) -> Iterator[Finding]:
    """Yield one finding an interpreter that is missing or belongs to another environment."""
    wrong: dict[str, list[Script]] = defaultdict(list)
    for script in scripts:
        is_wrong = not script.exists or (script.is_python and not script.is_own)
        if is_wrong and script.is_fixed:
            wrong[script.interpreter].append(script)
    mend = f'delete the folders build and install, then, after `{set_up}`: colcon build'
    for interpreter, found in sorted(wrong.items()):
        names = listing([script.path for script in found])
        if not found[0].exists:
            yield Finding(
                Severity.ERROR,
                f"the interpreter '{interpreter}' does not exist, but is named by: {names}",
                'these programs cannot start: the environment that they were built with has been '
                'moved or deleted',
                mend,
            )
        else:
            yield Finding(
                Severity.ERROR,
                f"'{interpreter}' is not the Python of this environment, but runs: {names}",
                'that Python does not have the wheels, so these programs end with an ImportError',
                mend,
            )
