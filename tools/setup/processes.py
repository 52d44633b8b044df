# SPDX-License-Identifier: Apache-2.0
"""Run the tools of the environment, untouched by whatever the user's shell has set up."""

from __future__ import annotations

from collections.abc import Callable, Sequence
import os
from pathlib import Path
import subprocess

from console import SetupError

INHERITED = {
    'AMENT_PREFIX_PATH',
    'CMAKE_PREFIX_PATH',
    'COLCON_PREFIX_PATH',
    'COLCON_PYTHON_EXECUTABLE',
    'LD_LIBRARY_PATH',
    'PIP_PREFIX',
    'PIP_TARGET',
    'PIP_USER',
    'PYTHONDONTWRITEBYTECODE',  # what is installed is compiled, which halves its start-up
    'PYTHONHOME',
    'PYTHONPATH',
    'ROS_DISTRO',
    'ROS_VERSION',
    'VIRTUAL_ENV',
}


def environment_variables(environment: Path) -> dict[str, str]:
    """Return the variables with which the environment's own programs run."""
    variables = without_inherited()
    variables['PATH'] = f'{environment}/bin{os.pathsep}{variables.get("PATH", os.defpath)}'
    variables['LD_LIBRARY_PATH'] = f'{environment}/lib'
    variables['CMAKE_PREFIX_PATH'] = str(environment)
    variables['_ROS_WHEELS_BOOTSTRAP_COMPLETE'] = '1'
    return variables


def without_inherited() -> dict[str, str]:
    """Return the variables of this process without those of another installation."""
    return {name: value for name, value in os.environ.items() if name not in INHERITED}


def run_logged(
    command: Sequence[str | Path],
    *,
    cwd: Path,
    variables: dict[str, str],
    log: Path,
    each_line: Callable[[str], None] = lambda line: None,
) -> int:
    """Run a program, keep what it prints in a file, and show each line to a function.

    Returns the exit status. An exception, as of Ctrl-C, ends the program too.
    """
    log.parent.mkdir(parents=True, exist_ok=True)
    with (
        log.open('w', encoding='utf-8') as record,
        subprocess.Popen(
            [str(part) for part in command],
            cwd=cwd,
            env=variables,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            encoding='utf-8',
            errors='replace',
        ) as process,
    ):
        try:
            assert process.stdout is not None
            for line in process.stdout:
                record.write(line)
                each_line(line.rstrip('\n'))
            return process.wait()
        except BaseException:
            process.terminate()
            raise


def last_words(log: Path, mark: str, count: int = 3) -> str:
    """Return the last lines of a log that hold a mark, or its last lines."""
    lines = [line for line in log.read_text(encoding='utf-8').splitlines() if line.strip()]
    return '\n'.join([line for line in lines if mark in line][-count:] or lines[-count:])


def run_or_fail(command: Sequence[str | Path], *, cwd: Path, failure: str) -> None:
    """Run a program that says nothing when all is well."""
    done = subprocess.run(
        [str(part) for part in command],
        cwd=cwd,
        capture_output=True,
        encoding='utf-8',
        check=False,
    )
    if done.returncode != 0:
        raise SetupError(f'{failure}:\n{(done.stderr or done.stdout).strip()}')
