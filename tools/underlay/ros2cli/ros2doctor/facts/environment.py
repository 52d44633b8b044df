# SPDX-License-Identifier: Apache-2.0
"""The variables and programs of the shell."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from importlib.util import find_spec
import os
from pathlib import Path
import shlex
import shutil
import sys

from ros2doctor.facts.prefix import environment_prefix, is_own
from ros2doctor.facts.scripts import read_script, Script

PATH_VARIABLES = ('AMENT_PREFIX_PATH', 'CMAKE_PREFIX_PATH', 'COLCON_PREFIX_PATH', 'PYTHONPATH')


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
