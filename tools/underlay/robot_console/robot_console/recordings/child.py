# SPDX-License-Identifier: Apache-2.0
"""Child processes of the console: their management, and in the child the way back to it."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
import json
import os
import queue
import re
import signal
import subprocess
import sys
import threading
import time
from typing import Any

__all__ = ['Child', 'Lifeline', 'interrupt_self', 'tell']

ENDING_S = 5.0
KEPT_LINES = 30
LOG_HEAD = re.compile(r'^\[(?P<level>\w+)\] (\[[^]]*\] )*(\[[^]]*\]: )?')
PROGRAM = re.compile(r'^[\w.]+: error: ')

GRACE_S = 20.0
CHUNK_BYTES = 65536
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
CUT: dict[str, Any] = {}


class Child:
    """
    A child process that runs a program of `robot_console.recordings.programs`.

    It receives commands, reports facts, and exits when its standard input is closed, which also
    happens if the parent process dies. It is started immediately.

    Parameters
    ----------
    program
        The module name of the program, for example `play`.
    arguments : Sequence[str]
        Its command line arguments.

    Attributes
    ----------
    facts
        The latest facts reported by the program, by name; replaced as a whole by another thread.

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
            start_new_session=True,  # Ctrl-C is for the console, which then stops it in order
        )
        self._readers = [
            threading.Thread(target=work, daemon=True) for work in (self._hear, self._collect)
        ]
        for reader in self._readers:
            reader.start()

    @property
    def pid(self) -> int:
        """Return the process ID."""
        return self._process.pid

    @property
    def is_running(self) -> bool:
        """Whether the process is running; kills it if it has exceeded the time to exit."""
        if self._process.poll() is not None:
            return False
        if time.monotonic() >= self._end_by_s:
            self._process.kill()
        return True

    @property
    def is_ending(self) -> bool:
        """Whether the process was requested to exit."""
        return self._end_by_s < float('inf')

    @property
    def failure(self) -> str:
        """Return the error message if the process has failed, otherwise ''."""
        status = self._process.poll()
        if not status:
            return ''
        for reader in self._readers:
            reader.join(timeout=0.5)
        return last_sentence(self._lines) or f'It ended with status {status}.'

    @property
    def warnings(self) -> list[str]:
        """Return the warnings that the process has logged."""
        return [_without_head(line) for line in list(self._lines) if _level(line) == 'WARN']

    def say(self, **command: Any) -> None:
        """
        Send a command to the program; ignored once it was requested to exit.

        Parameters
        ----------
        **command
            The members of the JSON object to send, such as `paused=True`.

        """
        pipe = self._process.stdin
        if pipe is None or self.is_ending:
            return
        try:
            pipe.write(json.dumps(command) + '\n')
            pipe.flush()
        except OSError:
            pass  # it has exited, which its status reports

    def end(self) -> None:
        """Request the process to exit; it finishes writing first."""
        if self.is_ending:
            return
        self._end_by_s = time.monotonic() + ENDING_S
        if self._process.stdin is not None:
            try:
                self._process.stdin.close()
            except OSError:
                pass  # it has already exited with unread input

    def close(self) -> None:
        """Stop the process, and wait until it has exited."""
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
                told = json.loads(line)
            except ValueError:
                told = None
            if isinstance(told, dict):
                self.facts = {**self.facts, **told}
            else:
                self._lines.append(line)

    def _collect(self) -> None:
        for line in self._process.stderr or ():
            self._lines.append(line.rstrip())


def last_sentence(lines: Iterable[str]) -> str:
    """
    Extract the error message from the output of a program.

    Parameters
    ----------
    lines
        The last lines of its output.

    Returns
    -------
    str
        The last line that is neither blank nor a log line of level INFO or DEBUG, without the log
        or program prefix; '' if there is none.

    """
    said = [line for line in lines if line.strip() and _level(line) not in ('INFO', 'DEBUG')]
    return PROGRAM.sub('', _without_head(said[-1])) if said else ''


def _level(line: str) -> str:
    match = LOG_HEAD.match(line)
    return match['level'] if match else ''


def _without_head(line: str) -> str:
    return LOG_HEAD.sub('', line).strip()


class Lifeline:
    """
    Receiver of commands from standard input, one JSON object per line.

    The lifeline is cut when the console closes the input or dies. If the program then does not
    exit within 20 s, because it hangs, it is terminated. Construct it in the main thread.

    Parameters
    ----------
    on_cut
        Called in another thread when standard input is closed.

    Attributes
    ----------
    is_cut
        Whether standard input is closed.

    """

    def __init__(self, on_cut: Callable[[], None] = lambda: None) -> None:
        self._waiting: queue.SimpleQueue[dict[str, Any]] = queue.SimpleQueue()
        self._on_cut = on_cut
        self.is_cut = False
        _hear_signals()
        threading.Thread(target=self._listen, daemon=True).start()

    def commands(self, timeout_s: float = 0.0) -> list[dict[str, Any]]:
        """
        Return the commands received so far.

        Parameters
        ----------
        timeout_s
            The time to wait for the first command, in s. The end of input also ends the wait.

        Returns
        -------
        list of dict
            The commands in order, often none.

        """
        found = []
        try:
            found.append(self._waiting.get(timeout=max(0.0, timeout_s)))
            while True:
                found.append(self._waiting.get_nowait())
        except queue.Empty:
            return [each for each in found if each]

    def _listen(self) -> None:
        for line in _lines():
            self._waiting.put(json.loads(line))
        self.is_cut = True
        self._waiting.put(CUT)  # wakes up a waiting reader
        self._on_cut()
        time.sleep(GRACE_S)
        os._exit(1)


def _lines() -> Iterator[bytes]:
    """Yield the lines of standard input, without a lock that would delay the exit."""
    text = b''
    while part := os.read(sys.stdin.fileno(), CHUNK_BYTES):
        *lines, text = (text + part).split(b'\n')
        yield from lines


def _hear_signals() -> None:
    """Restore the handling of signals that the parent process may have blocked or ignored."""
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, SIGNALS)


def interrupt_self() -> None:
    """Send SIGINT to this process, like Ctrl-C."""
    os.kill(os.getpid(), signal.SIGINT)


def tell(**facts: Any) -> None:
    """
    Report facts to the console on standard output; ignored if the console is gone.

    Parameters
    ----------
    **facts
        The members of a JSON object, which updates `Child.facts`.

    """
    try:
        sys.stdout.write(json.dumps(facts) + '\n')
        sys.stdout.flush()
    except OSError:
        pass
