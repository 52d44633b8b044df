# SPDX-License-Identifier: Apache-2.0
"""Check that the shell is set up for exactly one ROS 2 installation, this one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from importlib.util import find_spec
import os
from pathlib import Path
import platform
import shlex
import shutil
import sys

from ros2doctor.api.extension import DoctorCheck, DoctorReport, Finding, Report, Result, Severity
from ros2doctor.check.scripts import read_script, Script
from ros2doctor.check.wheels import environment_prefix, is_own

PATH_VARIABLES = ('AMENT_PREFIX_PATH', 'CMAKE_PREFIX_PATH', 'COLCON_PREFIX_PATH', 'PYTHONPATH')
DISTRO = 'jazzy'
MIDDLEWARE = 'rmw_fastrtps_cpp'
SYSTEM_FOLDER = '/opt/ros/'
PYTHON_RANGE = ((3, 10), (3, 13))
NEW_TERMINAL = 'open a new terminal and run: '
PREFIXES = ('ROS_', 'RMW_', 'RCUTILS_', 'FASTRTPS_', 'FASTDDS_', 'AMENT_', 'COLCON_', '_ROS_')
NAMES = (*PATH_VARIABLES, 'LD_LIBRARY_PATH', 'PATH', 'VIRTUAL_ENV', 'CONDA_PREFIX', 'SHELL')


@dataclass(frozen=True)
class Environment:
    """
    Environment that a shell passes on to the programs that it starts.

    :param python_version: major and minor version of the running Python
    :param prefix: the virtual environment with the wheels
    :param rclpy: path from which rclpy would be imported, if any
    :param other_python: the program that `python3` runs, if not that of the environment
    :param colcon: the program that `colcon` runs, if any
    :param has_current_folder: whether the current folder has not been deleted
    :param set_up: a command that sources or builds the nearest workspace
    """

    variables: Mapping[str, str]
    python_version: tuple[int, int]
    prefix: str
    rclpy: str | None
    other_python: str | None
    colcon: Script | None
    has_current_folder: bool
    set_up: str

    def folders(self, variable: str) -> list[str]:
        """
        List the folders in an environment variable such as PATH.

        Parameters
        ----------
        variable
            The name of the variable.

        Returns
        -------
        list of str
            The folders in their order, without empty ones; none if the variable is not set.

        """
        return [text for text in self.variables.get(variable, '').split(os.pathsep) if text]


def read_environment() -> Environment:
    """Return the environment of this process."""
    spec = find_spec('rclpy')
    colcon = shutil.which('colcon')
    python = shutil.which('python3')
    return Environment(
        variables=dict(os.environ),
        python_version=sys.version_info[:2],
        prefix=environment_prefix(),
        rclpy=spec.origin if spec else None,
        other_python=python if python and not is_own(python) else None,
        colcon=read_script(Path(colcon)) if colcon else None,
        has_current_folder=_has_current_folder(),
        set_up=set_up_command(),
    )


def _has_current_folder() -> bool:
    try:
        os.getcwd()
    except FileNotFoundError:
        return False
    return True


def set_up_command() -> str:
    """Return the command that sources or builds the nearest workspace in a new shell."""
    from ros_environment.workspace import workspaces

    for workspace in workspaces():
        script = workspace / 'install' / 'setup.bash'
        if script.is_file():
            return f'source {shlex.quote(str(script))}'
        if (workspace / 'tools' / 'setup').is_dir():
            folder = shlex.quote(str(workspace))
            return f'cd {folder} && make build && source install/setup.bash'
    return 'source install/setup.bash in the folder of your workspace'


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
            '`ros2` finds no packages, launch files or message types',
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
            'relative paths do not work, and many programs fail',
            'cd (if it has been created again: cd "$PWD")',
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
            f"RMW_IMPLEMENTATION is '{middleware}', for which PyPI has no wheel",
            'no node can start',
            f'export RMW_IMPLEMENTATION={MIDDLEWARE}',
        )


def _two_installations(facts: Environment) -> Iterator[Finding]:
    for variable in PATH_VARIABLES:
        foreign = [each for each in facts.folders(variable) if each.startswith(SYSTEM_FOLDER)]
        if foreign:
            yield Finding(
                Severity.ERROR,
                f"{variable} also contains another ROS, '{foreign[0]}'",
                'Python packages and libraries of the two get mixed, which leads to import errors '
                'and crashes',
                f'remove the line that sources {SYSTEM_FOLDER}... from ~/.bashrc, then '
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
            'it belongs to another installation, whose libraries are not compatible',
            NEW_TERMINAL + facts.set_up,
        )


def _build_tool(facts: Environment) -> Iterator[Finding]:
    colcon = facts.colcon
    if colcon is not None and not _is_below(colcon.path, facts.prefix):
        yield Finding(
            Severity.WARNING,
            f"`colcon` is '{colcon.path}', which runs with '{colcon.interpreter}'",
            'the scripts that it installs run with that interpreter, which has no rclpy',
            NEW_TERMINAL + facts.set_up,
        )


def _is_below(path: str, folder: str) -> bool:
    return os.path.realpath(path).startswith(os.path.realpath(folder) + os.sep)


def _dotted(version: tuple[int, int]) -> str:
    return '.'.join(map(str, version))


class EnvironmentReport(DoctorReport):
    """Report of the shell's variables and programs."""

    def category(self) -> str:
        """Return the category."""
        return 'environment'

    def report(self) -> Report:
        """Return the section."""
        facts = read_environment()
        report = Report('ROS 2 INFORMATION')
        report.add_to_report('distribution name', facts.variables.get('ROS_DISTRO', ''))
        report.add_to_report('rclpy', facts.rclpy)
        report.add_to_report('colcon', facts.colcon.path if facts.colcon else None)
        for name, value in sorted(facts.variables.items()):
            if name in NAMES or name.startswith(PREFIXES):
                report.add_to_report(name, value)
        return report


class PlatformReport(DoctorReport):
    """Report of the machine and its Python."""

    def category(self) -> str:
        """Return the category."""
        return 'platform'

    def report(self) -> Report:
        """Return the section."""
        report = Report('PLATFORM INFORMATION')
        report.add_to_report('system', platform.system())
        report.add_to_report('platform info', platform.platform())
        report.add_to_report('release', platform.release())
        report.add_to_report('processor', f'{platform.machine()}, {os.cpu_count()} cores')
        report.add_to_report('c library', ' '.join(platform.libc_ver()))
        report.add_to_report('python', f'{platform.python_version()}, {sys.executable}')
        return report
