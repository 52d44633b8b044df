# SPDX-License-Identifier: Apache-2.0
"""Check that the shell is set up for exactly one ROS 2 installation, this one."""

from __future__ import annotations

from collections.abc import Iterator
import os

from ros2doctor.api.extension import DoctorCheck
from ros2doctor.api.finding import Finding, Result, Severity
from ros2doctor.facts.environment import Environment, PATH_VARIABLES, read_environment

DISTRO = 'jazzy'
MIDDLEWARE = 'rmw_fastrtps_cpp'
SYSTEM_FOLDER = '/opt/ros/'
PYTHON_RANGE = ((3, 10), (3, 13))
NEW_TERMINAL = 'open a new terminal and run: '


class EnvironmentCheck(DoctorCheck):
    """Check of the shell's variables and programs."""

    def category(self) -> str:
        """Return the category."""
        return 'environment'

    def check(self) -> Result:
        """Check the environment of this process."""
        return Result(environment_findings(read_environment()))


def environment_findings(facts: Environment) -> Iterator[Finding]:
    """
    Report problems of the environment variables and programs of a shell.

    Without a sourced ROS 2 environment, anything that depends on one is not examined.

    Parameters
    ----------
    facts
        The environment, as `read_environment` gives it.

    Yields
    ------
    Finding
        An error or a warning each.

    """
    yield from _python(facts)
    yield from _current_folder(facts)
    if not facts.folders('AMENT_PREFIX_PATH'):
        yield Finding(
            Severity.ERROR,
            'no ROS 2 environment is sourced in this terminal (AMENT_PREFIX_PATH is empty)',
            '`ros2` finds no package, no launch file and no message type',
            facts.set_up,
        )
        return
    yield from _distribution(facts)
    yield from _two_installations(facts)
    yield from _vanished_folders(facts)
    yield from _other_python(facts)
    yield from _client_library(facts)
    yield from _build_tool(facts)


def _python(facts: Environment) -> Iterator[Finding]:
    oldest, newest = PYTHON_RANGE
    if not oldest <= facts.python_version <= newest:
        yield Finding(
            Severity.ERROR,
            f'this is Python {_dotted(facts.python_version)}',
            f'the ROS 2 wheels exist for Python {_dotted(oldest)} to {_dotted(newest)} only',
            'make distclean setup PYTHON=python3.12',
        )


def _current_folder(facts: Environment) -> Iterator[Finding]:
    if not facts.has_current_folder:
        yield Finding(
            Severity.WARNING,
            'the current folder of this terminal has been deleted',
            'relative paths lead nowhere, and many programs end with an error',
            'cd (if it has been made anew: cd "$PWD")',
        )


def _distribution(facts: Environment) -> Iterator[Finding]:
    distro = facts.variables.get('ROS_DISTRO', '')
    if distro != DISTRO:
        yield Finding(
            Severity.ERROR,
            f"ROS_DISTRO is '{distro}' instead of '{DISTRO}'",
            'packages of different distributions do not work together: messages and libraries '
            'differ',
            NEW_TERMINAL + facts.set_up,
        )
    middleware = facts.variables.get('RMW_IMPLEMENTATION', MIDDLEWARE)
    if middleware != MIDDLEWARE:
        yield Finding(
            Severity.ERROR,
            f"RMW_IMPLEMENTATION is '{middleware}', of which PyPI has no wheel",
            'no node can start',
            f'export RMW_IMPLEMENTATION={MIDDLEWARE}',
        )


def _two_installations(facts: Environment) -> Iterator[Finding]:
    for variable in PATH_VARIABLES:
        foreign = [each for each in facts.folders(variable) if each.startswith(SYSTEM_FOLDER)]
        if foreign:
            yield Finding(
                Severity.ERROR,
                f"{variable} also names another ROS, '{foreign[0]}'",
                'Python packages and libraries of the two get mixed, which ends in import errors '
                'and crashes',
                f'take the line that sources {SYSTEM_FOLDER}... out of ~/.bashrc, then '
                f'{NEW_TERMINAL}{facts.set_up}',
            )


def _vanished_folders(facts: Environment) -> Iterator[Finding]:
    for variable in ('AMENT_PREFIX_PATH', 'COLCON_PREFIX_PATH'):
        for folder in facts.folders(variable):
            if not os.path.isdir(folder) and not folder.startswith(SYSTEM_FOLDER):
                yield Finding(
                    Severity.WARNING,
                    f"{variable} names the folder '{folder}', which does not exist (any more)",
                    'what was sourced has been moved or deleted since, so its packages are not '
                    'found',
                    NEW_TERMINAL + facts.set_up,
                )


def _other_python(facts: Environment) -> Iterator[Finding]:
    if facts.other_python:
        yield Finding(
            Severity.ERROR,
            f"`python3` is '{facts.other_python}', outside of '{facts.prefix}'",
            'that Python does not have the wheels; something has changed PATH since the '
            'environment was sourced (conda and pyenv do that)',
            f'conda deactivate, or {NEW_TERMINAL}{facts.set_up}',
        )


def _client_library(facts: Environment) -> Iterator[Finding]:
    if facts.rclpy is not None and not _is_below(facts.rclpy, facts.prefix):
        yield Finding(
            Severity.ERROR,
            f"rclpy would be imported from '{facts.rclpy}', outside of '{facts.prefix}'",
            'it belongs to another installation, whose libraries do not fit',
            NEW_TERMINAL + facts.set_up,
        )


def _build_tool(facts: Environment) -> Iterator[Finding]:
    colcon = facts.colcon
    if colcon is not None and not _is_below(colcon.path, facts.prefix):
        yield Finding(
            Severity.WARNING,
            f"`colcon` is '{colcon.path}', which runs with '{colcon.interpreter}'",
            'what it builds gets that interpreter in its first line, which has no rclpy',
            NEW_TERMINAL + facts.set_up,
        )


def _is_below(path: str, folder: str) -> bool:
    return os.path.realpath(path).startswith(os.path.realpath(folder) + os.sep)


def _dotted(version: tuple[int, int]) -> str:
    return '.'.join(map(str, version))
