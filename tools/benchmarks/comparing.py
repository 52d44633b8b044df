# SPDX-License-Identifier: Apache-2.0
"""Compare what commands cost in this workspace and in another one, run in turn.

Machines differ, and the speed of one wanders with what else it does. What can be trusted is the
ratio of two programs that ran in turn, and of each the least of many runs.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
import ctypes
from dataclasses import dataclass
import os
from pathlib import Path
import shlex
import subprocess

HERE = Path(__file__).resolve().parents[2]
PR_SET_CHILD_SUBREAPER = 36
NOT_OF_A_USER = ('PYTHONDONTWRITEBYTECODE', 'PYTHONUNBUFFERED', 'PYTHONPATH')


@dataclass(frozen=True)
class Workspace:
    """A built workspace.

    Attributes
    ----------
    environment
        The variables that a shell has after `source install/setup.bash`.

    """

    environment: Mapping[str, str]

    @classmethod
    def at(cls, folder: Path) -> Workspace:
        """
        Read the environment of a workspace.

        Parameters
        ----------
        folder
            The folder of the workspace, which `built_workspace` has found to be one.

        """
        script = folder / 'tools' / 'in_environment'
        outside = {name: text for name, text in os.environ.items() if name not in NOT_OF_A_USER}
        outside['PATH'] = without_environments(outside['PATH'])
        command = [script, 'env', '-0']
        listing = subprocess.run(command, env=outside, capture_output=True, check=True).stdout
        pairs = (entry.partition('=') for entry in os.fsdecode(listing).split('\0'))
        return cls({name: text for name, _, text in pairs if name})

    def cpu_s(self, command: str) -> float:
        """
        Measure the CPU time of a command and of all that it starts, until the last has ended.

        Call `adopt_orphans` before: otherwise processes that outlive the command do not count.

        Parameters
        ----------
        command
            The program and its arguments, as for a shell.

        Returns
        -------
        float
            User and system time in s.

        Raises
        ------
        RuntimeError
            The command fails: what does not work costs nothing.
        ValueError
            The workspace has no such program.

        """
        words = shlex.split(command)
        program = _find(words[0], self.environment['PATH'])
        process = subprocess.Popen(
            [program, *words[1:]],
            env=self.environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            raise RuntimeError(f'`{command}` of {program} has ended with {process.returncode}')
        return usage.ru_utime + usage.ru_stime + collect_orphans()


def print_comparison(commands: Iterable[tuple[str, str]], other: Path, runs: int) -> None:
    """Print a row a command: the least CPU times here and there, and their ratio.

    Parameters
    ----------
    commands
        What is run, and what it is called in the table.
    other
        The folder of the other workspace.
    runs
        How often each command runs in each workspace, after a run that is not counted.

    """
    adopt_orphans()
    here, there = Workspace.at(HERE), Workspace.at(other)
    print(f'Least CPU time of {runs} runs in turn, {HERE} against {other}')
    print(f'{"here s":>7} {"there s":>7} {"ratio":>6}  command')
    for command, name in commands:
        pairs = [(here.cpu_s(command), there.cpu_s(command)) for _ in range(runs + 1)][1:]
        least_here, least_there = map(min, zip(*pairs))
        ratio = least_here / least_there
        print(f'{least_here:7.3f} {least_there:7.3f} {ratio:6.2f}  {name}', flush=True)


def adopt_orphans() -> None:
    """Become the parent of every process that loses its own, so that none is forgotten."""
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0) != 0:
        raise OSError(ctypes.get_errno(), 'this process cannot adopt orphans')


def collect_orphans() -> float:
    """Wait for what a command has left behind, as a server that it forked; return its CPU time."""
    total_s = 0.0
    while True:
        try:
            _, _, usage = os.wait4(-1, 0)
        except ChildProcessError:
            return total_s
        total_s += usage.ru_utime + usage.ru_stime


def without_environments(path: str) -> str:
    """
    Remove the folders of virtual environments from a PATH: each workspace adds its own.

    Parameters
    ----------
    path
        The text of the variable.

    """
    folders = [Path(folder) for folder in path.split(os.pathsep)]
    kept = [folder for folder in folders if not (folder.parent / 'pyvenv.cfg').exists()]
    return os.pathsep.join(map(str, kept))


def _find(program: str, path: str) -> str:
    for folder in path.split(os.pathsep):
        candidate = os.path.join(folder, program)
        if os.access(candidate, os.X_OK):
            return candidate
    raise ValueError(f"'{program}' is not in {path}")
