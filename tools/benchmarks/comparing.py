# SPDX-License-Identifier: Apache-2.0
"""Compare what commands cost in this workspace and in another one, run in turn.

Machines differ, and the speed of each varies with its load. Only the ratio of two programs
that ran in turn is reliable, with the minimum of many runs of each.
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
            The folder of the workspace, validated by `built_workspace`.

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
        Measure the CPU time of a command and all its descendants, until the last has ended.

        Call `adopt_orphans` before: otherwise processes that outlive the command are not counted.

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
            The command fails, so that its cost is meaningless.
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
    """Print a row for each command: the minimum CPU times here and there, and their ratio.

    Parameters
    ----------
    commands
        The commands, and their names in the table.
    other
        The folder of the other workspace.
    runs
        The number of runs of each command in each workspace, after a warm-up run.

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
    """Become a subreaper: the parent of orphaned descendants, so that all are counted."""
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0) != 0:
        raise OSError(ctypes.get_errno(), 'this process cannot adopt orphans')


def collect_orphans() -> float:
    """Wait for processes that outlive a command, such as a daemon; return their CPU time."""
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
        The value of the variable.

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
