# SPDX-License-Identifier: Apache-2.0
"""A program that the console has started, and that ends with it."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Sequence
import json
import re
import subprocess
import sys
import threading
import time
from typing import Any

__all__ = ['Child']

ENDING_S = 5.0
KEPT_LINES = 30
LOG_HEAD = re.compile(r'^\[(?P<level>\w+)\] (\[[^]]*\] )*(\[[^]]*\]: )?')
PROGRAM = re.compile(r'^[\w.]+: error: ')


class Child:
    """
    A child process that runs a program of `robot_console.recordings.programs`.

    It hears commands, tells facts, and ends when its standard input is closed, which happens
    whatever becomes of this process. It is started at once.

    Parameters
    ----------
    program
        The name of the module of the program, such as `play`.
    arguments : Sequence[str]
        Its command line arguments.

    Attributes
    ----------
    facts
        What the program has told last, by name; replaced as a whole by another thread.

    """

    def __init__(self, program: str, arguments: Sequence[str]) -> None:
        self.facts: dict[str, Any] = {}
        self._lines: deque[str] = deque(maxlen=KEPT_LINES)
        self._end_by_s = float('inf')
        self._process = subprocess.Popen(
            [sys.executable, '-m', f'robot_console.recordings.programs.{program}', *arguments],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            errors='replace',
            cwd='/',
            start_new_session=True,  # Ctrl-C is for the console, which then ends it in order
        )
        self._readers = [
            threading.Thread(target=work, daemon=True) for work in (self._hear, self._collect)
        ]
        for reader in self._readers:
            reader.start()

    @property
    def pid(self) -> int:
        """Return the number of the process."""
        return self._process.pid

    @property
    def is_running(self) -> bool:
        """Tell if it runs; one that was asked to end and does not is killed."""
        if self._process.poll() is not None:
            return False
        if time.monotonic() >= self._end_by_s:
            self._process.kill()
        return True

    @property
    def is_ending(self) -> bool:
        """Tell if it was asked to end."""
        return self._end_by_s < float('inf')

    @property
    def failure(self) -> str:
        """Return what it said at its end if that was an early one, otherwise ''."""
        status = self._process.poll()
        if not status:
            return ''
        for reader in self._readers:
            reader.join(timeout=0.5)
        return last_sentence(self._lines) or f'It ended with status {status}.'

    @property
    def warnings(self) -> list[str]:
        """Return what it warned of."""
        return [_without_head(line) for line in list(self._lines) if _level(line) == 'WARN']

    def say(self, **command: Any) -> None:
        """
        Send a command to the program; nothing is sent once it was asked to end.

        Parameters
        ----------
        **command
            The members of the JSON object that is sent, such as `paused=True`.

        """
        pipe = self._process.stdin
        if pipe is None or self.is_ending:
            return
        try:
            pipe.write(json.dumps(command) + '\n')
            pipe.flush()
        except OSError:
            pass  # it has ended by itself, which its status tells

    def end(self) -> None:
        """Ask it to end; it finishes what it writes."""
        if self.is_ending:
            return
        self._end_by_s = time.monotonic() + ENDING_S
        if self._process.stdin is not None:
            try:
                self._process.stdin.close()
            except OSError:
                pass  # it has ended already, with something unread

    def close(self) -> None:
        """End it, and wait until it has ended."""
        self.end()
        try:
            self._process.wait(max(0.0, self._end_by_s - time.monotonic()))
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        for reader in self._readers:
            reader.join(timeout=1.0)

    def _hear(self) -> None:
        for line in self._process.stdout or ():
            try:
                self.facts = {**self.facts, **json.loads(line)}
            except ValueError:
                self._lines.append(line)

    def _collect(self) -> None:
        for line in self._process.stderr or ():
            self._lines.append(line.rstrip())


def last_sentence(lines: Iterable[str]) -> str:
    """
    Extract the reason for a failure from the output of a program.

    Parameters
    ----------
    lines
        The last lines of its output.

    Returns
    -------
    str
        The last line that is neither blank nor a log of level INFO or DEBUG, without the prefix of
        the log or the program; '' if there is none.

    """
    said = [line for line in lines if line.strip() and _level(line) not in ('INFO', 'DEBUG')]
    return PROGRAM.sub('', _without_head(said[-1])) if said else ''


def _level(line: str) -> str:
    match = LOG_HEAD.match(line)
    return match['level'] if match else ''


def _without_head(line: str) -> str:
    return LOG_HEAD.sub('', line).strip()
