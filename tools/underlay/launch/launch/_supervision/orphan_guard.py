# SPDX-License-Identifier: Apache-2.0
"""
Clean up after a launch that was killed.

Two small watchdog processes, the guards, wait at the other ends of pipes for messages of the
launch, and for its death. They are redundant: a guard that exits is replaced, one that was stopped
is resumed by the kernel at the moment the launch dies, and each can do the work alone.
"""

from __future__ import annotations

import asyncio
import fcntl
import os
import signal
import subprocess
import sys
import time
from typing import Optional

from launch._supervision.family import Family, unmarked
from launch.logging import get_logger

# The shell blocks in `read` until the launch sends 'bye' or dies. If it dies, the shell runs
# `cleanup.py`; if that fails, the shell itself kills the groups and removes the files.
_SCRIPT = """
trap '' INT TERM HUP QUIT
python=$1 cleanup=$2 delay=$3
shift 3
groups=' ' files=
while IFS= read -r line; do
  case $line in
    'add '*) groups="$groups${line#add } " ;;
    'end '*) line=${line#end }; groups="${groups%% $line *} ${groups#* $line }" ;;
    'file '*) files="$files${line#file }
" ;;
    bye) exit 0 ;;
  esac
done
sleep "$delay"
printf '%s\\n%s' "$groups" "$files" | "$python" -E -s -S "$cleanup" "$@" && exit 0
for signal in TERM KILL; do
  for group in $groups; do kill -s $signal -- "-$group" 2>/dev/null && sleep 1; done
done
printf %s "$files" | while IFS= read -r file; do rm -f -- "$file"; done
"""
_CLEANUP = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'cleanup.py')
_DELAYS_S = (0, 2.5)
"""Delays of the guards in s before they clean up; the second guard is a fallback."""
_SECOND_AFTER_S = 1.0
_LONGEST_PAUSE_S = 1.0

_open_pipes: set[int] = set()


class OrphanGuard:
    """
    Watchdog for the processes and the files of a launch, outside its process.

    Even if the launch is killed without a chance to clean up, they are terminated and removed.

    Parameters
    ----------
    family
        The processes of the launch.
    loop
        The event loop that replaces guards that have exited; without one there is a single guard,
        which is not replaced.

    """

    def __init__(self, family: Family, loop: Optional[asyncio.AbstractEventLoop] = None) -> None:
        self._family = family
        self._loop = loop
        self._groups: set[int] = set()
        self._files: list[str] = []
        self._shells: dict[int, _Shell] = {}
        self._planned: list[asyncio.TimerHandle] = []
        self._is_started = False

    @property
    def pids(self) -> list[int]:
        """Return the process ids of the guards."""
        return [shell.pid for shell in self._shells.values()]

    def start(self) -> None:
        """Start watching, with one guard at first and a second one shortly after."""
        if self._is_started:
            return
        self._is_started = True
        self._start_shell(0)
        self._plan(1, _SECOND_AFTER_S)

    def add(self, group: int) -> None:
        """
        Watch a process group, even if its processes lose their marks.

        Parameters
        ----------
        group
            The id of the group, which is also that of its session.

        """
        self._groups.add(group)
        self._tell(f'add {group}\n')

    def remove(self, group: int) -> None:
        """
        Stop watching a process group that has ended.

        Parameters
        ----------
        group
            The id of the group.

        """
        self._groups.discard(group)
        self._tell(f'end {group}\n')

    def add_file(self, path: str) -> None:
        """
        Register a file to be removed if the launch is killed.

        Parameters
        ----------
        path
            The absolute path of the file; nothing is done if it contains a line break.

        """
        if '\n' not in path:
            self.start()
            self._files.append(path)
            self._tell(f'file {path}\n')

    def close(self) -> None:
        """Stop the guards, as there is nothing left to watch."""
        for timer in self._planned:
            timer.cancel()
        for shell in self._shells.values():
            shell.say_bye()
        for shell in self._shells.values():
            self._stop_watching(shell)
            shell.close()
        self._shells.clear()

    def _tell(self, text: str) -> None:
        for shell in self._shells.values():
            shell.tell(text)

    # The processes.

    def _start_shell(self, number: int) -> None:
        family = self._family
        arguments = [str(_DELAYS_S[number]), family.id, str(family.mark), str(family.start_ticks)]
        try:
            shell = _Shell(arguments)
        except OSError as error:
            get_logger('launch').warning(
                'nothing cleans up if this launch is killed, because /bin/sh cannot be run: %s',
                error,
            )
            return
        shell.tell(''.join(f'add {group}\n' for group in sorted(self._groups)))
        shell.tell(''.join(f'file {path}\n' for path in self._files))
        self._shells[number] = shell
        if self._loop is not None and shell.pidfd >= 0:
            self._loop.add_reader(shell.pidfd, self._replace, number)

    def _replace(self, number: int) -> None:
        """Replace a guard that has exited."""
        shell = self._shells.pop(number)
        self._stop_watching(shell)
        shell.close()
        lived_s = time.monotonic() - shell.started_s
        self._plan(number, 0.0 if lived_s > _LONGEST_PAUSE_S else _LONGEST_PAUSE_S)

    def _plan(self, number: int, delay_s: float) -> None:
        if self._loop is not None:
            self._planned = [timer for timer in self._planned if timer.when() > self._loop.time()]
            self._planned.append(self._loop.call_later(delay_s, self._start_shell, number))

    def _stop_watching(self, shell: _Shell) -> None:
        if self._loop is not None and shell.pidfd >= 0:
            self._loop.remove_reader(shell.pidfd)


class _Shell:
    """Guard process, in a session of its own."""

    def __init__(self, arguments: list[str]) -> None:
        """Start the guard; raise an OSError if this is not possible."""
        reading_end, self._pipe = os.pipe()
        os.set_blocking(self._pipe, False)
        command = ['/bin/sh', '-c', _SCRIPT, 'guard', sys.executable or 'python3', _CLEANUP]
        try:
            with unmarked():
                self._process = subprocess.Popen(
                    [*command, *arguments],
                    stdin=reading_end,
                    stdout=subprocess.DEVNULL,
                    stderr=subprocess.DEVNULL,
                    cwd='/',
                    env={'PATH': '/usr/bin:/bin'},
                    start_new_session=True,
                )
            _let_end_wake(reading_end, self._process.pid)
        except OSError:
            os.close(self._pipe)
            raise
        finally:
            os.close(reading_end)
        _open_pipes.add(self._pipe)
        self.started_s = time.monotonic()
        self.pidfd = _pidfd(self.pid)

    @property
    def pid(self) -> int:
        """Return the id of the process."""
        return self._process.pid

    def tell(self, text: str) -> None:
        """Send text to the guard; ignored if it has exited."""
        try:
            os.write(self._pipe, text.encode('utf-8', 'surrogateescape'))
        except OSError:
            pass

    def say_bye(self) -> None:
        """Make the guard exit without cleaning up, even if it was stopped."""
        self._process.send_signal(signal.SIGCONT)
        os.set_blocking(self._pipe, True)
        self.tell('bye\n')

    def close(self) -> None:
        """Wait for the guard to exit, after `say_bye` or its death."""
        _open_pipes.discard(self._pipe)
        os.close(self._pipe)
        self._process.wait()
        if self.pidfd >= 0:
            os.close(self.pidfd)


def _let_end_wake(reading_end: int, pid: int) -> None:
    """Make the kernel send SIGCONT to a process when a pipe becomes readable or is closed."""
    fcntl.fcntl(reading_end, fcntl.F_SETOWN, pid)
    fcntl.fcntl(reading_end, fcntl.F_SETSIG, signal.SIGCONT)
    flags = fcntl.fcntl(reading_end, fcntl.F_GETFL)
    fcntl.fcntl(reading_end, fcntl.F_SETFL, flags | os.O_ASYNC)


def _pidfd(pid: int) -> int:
    try:
        return os.pidfd_open(pid)
    except (AttributeError, OSError):
        return -1


def _close_pipes() -> None:
    """Close the inherited pipes in a forked child, so that it does not hide the launch's death."""
    for pipe in _open_pipes:
        os.close(pipe)
    _open_pipes.clear()


os.register_at_fork(after_in_child=_close_pipes)
