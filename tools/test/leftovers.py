# SPDX-License-Identifier: Apache-2.0
"""
Processes that have outlived what started them: they are known by a mark in their environment.

As a program, `leftovers.py PID MARK` waits for the end of a process of tests and then kills what
bears its mark. However that process ended, no robot that it started stands in the way of others.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time

_POLL_S = 0.5
_LAST_S = 30.0


def kill_at_the_end(mark: str, stderr: int) -> None:
    """
    Start a program that waits for the end of this process, and kills what bears a mark.

    Parameters
    ----------
    mark
        `NAME=value`, as in the environment of the processes; this process does not bear it yet.
    stderr
        The file descriptor to which it says what it has killed.

    """
    # A child of nobody's: tests count the children of their process.
    command = ['/bin/sh', '-c', '"$@" &', 'sh', sys.executable, '-E', '-s', '-S', __file__]
    subprocess.run(
        [*command, str(os.getpid()), mark],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=stderr,
        env={},  # without the mark of a process that started this one
        start_new_session=True,
        check=True,
    )


def members(mark: str) -> list[int]:
    """
    Find the processes that bear a mark.

    Parameters
    ----------
    mark
        `NAME=value`, as in their environment.

    Returns
    -------
    list[int]
        The ids of those that are running.

    """
    pids = [int(name) for name in os.listdir('/proc') if name.isdigit()]
    return [pid for pid in pids if mark.encode() in _environment(pid) and runs(pid)]


def runs(pid: int) -> bool:
    """Tell whether a process is there and is more than a zombie."""
    try:
        with open(f'/proc/{pid}/stat') as file:
            return file.read().rpartition(')')[2].split()[0] != 'Z'
    except (FileNotFoundError, ProcessLookupError):
        return False


def _environment(pid: int) -> list[bytes]:
    return _read(f'/proc/{pid}/environ').split(b'\0')


def _read(path: str) -> bytes:
    try:
        with open(path, 'rb') as file:
            return file.read()
    except OSError:
        return b''


def _kill(mark: str) -> None:
    """Kill what bears a mark, and what it starts meanwhile; say what that was."""
    end_s = time.monotonic() + _LAST_S
    known: set[int] = set()
    while (left := members(mark)) and time.monotonic() < end_s:
        for pid in left:
            if pid not in known:
                command = (
                    _read(f'/proc/{pid}/cmdline').replace(b'\0', b' ').decode(errors='replace')
                )
                print(f'A process outlived its tests: {command[:200]}', file=sys.stderr)
            known.add(pid)
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        time.sleep(0.05)


if __name__ == '__main__':
    if len(sys.argv) != 3 or not sys.argv[1].isdecimal() or '=' not in sys.argv[2]:
        sys.exit(
            'usage: leftovers.py PID MARK, with the process to wait for and the NAME=value that '
            'the processes to kill have in their environment'
        )
    watched, of_tests = int(sys.argv[1]), sys.argv[2]
    while runs(watched):
        time.sleep(_POLL_S)
    _kill(of_tests)
