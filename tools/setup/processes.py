# SPDX-License-Identifier: Apache-2.0
"""Run the tools of the environment, isolated from the setup of the user's shell."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
import os
from pathlib import Path
import signal
import subprocess
from typing import Any

from console import SetupError

GRACE_S = 5.0
KEPT_OPEN: list[int] = []  # descriptors that the programs inherit, such as the workspace lock
INHERITED = {
    'AMENT_PREFIX_PATH',
    'CMAKE_PREFIX_PATH',
    'COLCON_PREFIX_PATH',
    'COLCON_PYTHON_EXECUTABLE',
    'LD_LIBRARY_PATH',
    'PIP_PREFIX',
    'PIP_TARGET',
    'PIP_USER',
    'PYTHONDONTWRITEBYTECODE',  # installed modules are compiled, which halves the start-up time
    'PYTHONHOME',
    'PYTHONPATH',
    'ROS_DISTRO',
    'ROS_VERSION',
    'VIRTUAL_ENV',
}


def environment_variables(environment: Path) -> dict[str, str]:
    """
    Compute the environment variables for the environment's own programs.

    Parameters
    ----------
    environment
        The prefix of the programs.

    Returns
    -------
    dict of str to str
        All variables of a process, as for `subprocess.Popen`.

    """
    variables = without_inherited()
    variables['PATH'] = f'{environment}/bin{os.pathsep}{variables.get("PATH", os.defpath)}'
    variables['LD_LIBRARY_PATH'] = f'{environment}/lib'
    variables['CMAKE_PREFIX_PATH'] = str(environment)
    variables['_ROS_WHEELS_BOOTSTRAP_COMPLETE'] = '1'
    return variables


def without_inherited() -> dict[str, str]:
    """Return the variables of this process without those of another installation."""
    return {name: value for name, value in os.environ.items() if name not in INHERITED}


@contextmanager
def started(command: Sequence[str | Path], **options: Any) -> Iterator[subprocess.Popen[str]]:
    """
    Start a program in its own session; an exception ends it with all its descendants.

    Parameters
    ----------
    command
        The program and its arguments.
    **options
        Further arguments of `subprocess.Popen`.

    Yields
    ------
    Popen
        The process, which may outlive the block if no exception ends it.

    """
    process = subprocess.Popen(
        [str(part) for part in command],
        stdin=subprocess.DEVNULL,
        start_new_session=True,
        pass_fds=KEPT_OPEN,
        encoding='utf-8',
        errors='replace',
        **options,
    )
    try:
        yield process
    except BaseException:
        _end_session(process)
        raise
    finally:
        if process.stdout:
            process.stdout.close()


def _end_session(process: subprocess.Popen[str]) -> None:
    """Terminate all processes of a session, and kill those that remain."""
    with suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGTERM)
        with suppress(subprocess.TimeoutExpired):
            process.wait(timeout=GRACE_S)
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def run_logged(
    command: Sequence[str | Path],
    *,
    cwd: Path,
    variables: dict[str, str],
    log: Path,
    each_line: Callable[[str], None] = lambda line: None,
) -> int:
    """
    Run a program, log its output to a file, and pass each line to a function.

    Parameters
    ----------
    command
        The program and its arguments.
    cwd
        Its working directory.
    variables
        All of its environment variables.
    log
        The file for stdout and stderr, which is overwritten.
    each_line
        Called with each line, without the line break.

    Returns
    -------
    int
        The exit status.

    """
    log.parent.mkdir(parents=True, exist_ok=True)
    output = {'stdout': subprocess.PIPE, 'stderr': subprocess.STDOUT}
    with log.open('w', encoding='utf-8') as record:
        with started(command, cwd=cwd, env=variables, **output) as process:
            for line in process.stdout or ():
                record.write(line)
                each_line(line.rstrip('\n'))
            return process.wait()


def run(command: Sequence[str | Path], *, cwd: Path, variables: dict[str, str]) -> int:
    """
    Run a program that prints to the terminal; return the exit status.

    Parameters
    ----------
    command
        The program and its arguments.
    cwd
        Its working directory.
    variables
        All of its environment variables.

    """
    with started(command, cwd=cwd, env=variables) as process:
        return process.wait()


def last_words(log: Path, mark: str, count: int = 3) -> str:
    """
    Quote the last lines of a log that contain a mark, or its last lines if none does.

    Parameters
    ----------
    log
        The file.
    mark
        A string such as `ERROR`.
    count
        The maximum number of lines to quote.

    """
    lines = [line for line in log.read_text(encoding='utf-8').splitlines() if line.strip()]
    return '\n'.join([line for line in lines if mark in line][-count:] or lines[-count:])


def run_or_fail(command: Sequence[str | Path], *, cwd: Path, failure: str) -> None:
    """
    Run a program whose output is only shown on failure.

    Parameters
    ----------
    command
        The program and its arguments.
    cwd
        Its working directory.
    failure
        The start of the message if it fails.

    Raises
    ------
    SetupError
        The exit status is not 0; the message quotes the output.

    """
    output = {'stdout': subprocess.PIPE, 'stderr': subprocess.STDOUT}
    with started(command, cwd=cwd, **output) as process:
        text, _ = process.communicate()
    if process.returncode != 0:
        raise SetupError(f'{failure}:\n{text.strip()}')
