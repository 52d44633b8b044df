# SPDX-License-Identifier: Apache-2.0
"""Find executables of packages and run them as child processes that never outlive the command."""

from __future__ import annotations

import errno
import os
import signal
import sys

__all__ = ['MultipleExecutables', 'get_executable_path', 'run_executable']

FORWARDED = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT)
SENT_BY_KERNEL = 0x80


class MultipleExecutables(Exception):
    """Several executables of a package have the same name."""

    def __init__(self, paths: list[str]) -> None:
        """Initialize with the found paths."""
        super().__init__(', '.join(paths))
        self.paths = paths


def get_executable_path(*, package_name: str, executable_name: str) -> str | None:
    """
    Find an executable of a package by its file name.

    Parameters
    ----------
    package_name, executable_name
        The package, and the name of the file in or below its `lib/<package_name>`.

    Returns
    -------
    str or None
        The path, or None if the package has no such executable.

    Raises
    ------
    PackageNotFoundError
        The package is not installed.
    MultipleExecutables
        Several executables have this name.

    """
    from ros2pkg.api import get_executable_paths

    paths = [
        path
        for path in get_executable_paths(package_name=package_name)
        if os.path.basename(path) == executable_name
    ]
    if len(paths) > 1:
        raise MultipleExecutables(paths)
    return paths[0] if paths else None


def run_executable(*, path: str, argv: list[str], prefix: list[str] | None = None) -> int:
    """
    Run an executable in the foreground until it exits.

    Parameters
    ----------
    path
        The executable.
    argv
        Its arguments.
    prefix
        The prefix command, such as `gdb -ex run --args`, as a list of words.

    Returns
    -------
    int
        The exit status, or the negative number of the signal that terminated it.

    Raises
    ------
    RuntimeError
        The executable, or the first word of the prefix, cannot be run.

    """
    return _run_child([*(prefix or ()), path, *argv])


def _run_child(command: list[str]) -> int:
    """
    Run a command in the foreground until it exits, and forward signals to it.

    The child stays in the terminal's foreground process group, so that it can read the keyboard.
    Ctrl-C reaches it from the terminal, and is therefore not forwarded a second time.

    Parameters
    ----------
    command
        The program, searched for in `PATH` if it has no slash, and its arguments.

    Returns
    -------
    int
        The exit status, or the negative number of the signal that terminated it.

    Raises
    ------
    RuntimeError
        The program cannot be run.

    """
    signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    waited = {*FORWARDED, signal.SIGCHLD}
    previous = signal.pthread_sigmask(signal.SIG_BLOCK, waited)
    sys.stdout.flush()
    try:
        pid = os.posix_spawnp(command[0], command, os.environ, setsigmask=previous)
        return _wait(pid, waited)
    except OSError as error:
        raise RuntimeError(_why_not(command[0], error)) from error
    finally:
        _drop_pending(waited)
        signal.pthread_sigmask(signal.SIG_SETMASK, previous)


def _why_not(program: str, error: OSError) -> str:
    text = f"cannot run '{program}': {error.strerror}"
    if error.errno == errno.ENOEXEC:
        return f'{text}. Is it a script without an interpreter in its first line (#!)?'
    if error.errno == errno.ENOENT and os.path.exists(program):
        return f'{text}. Its first line (#!) names an interpreter that does not exist.'
    return text


def _wait(pid: int, waited: set[signal.Signals]) -> int:
    """Forward signals until the child has exited."""
    while True:
        ended, status = os.waitpid(pid, os.WNOHANG)
        if ended:
            return os.waitstatus_to_exitcode(status)
        received = signal.sigwaitinfo(waited)
        if received.si_signo != signal.SIGCHLD and received.si_code != SENT_BY_KERNEL:
            os.kill(pid, received.si_signo)


def _drop_pending(waited: set[signal.Signals]) -> None:
    """Discard pending signals that arrived after the child's exit; they were meant for it."""
    while signal.sigtimedwait(waited, 0):
        continue
