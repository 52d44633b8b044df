# SPDX-License-Identifier: Apache-2.0
"""
Run a student's program in a process group of its own, with bounded output, and end it.

Descendants that leave the group are found by a mark in their environment. One that leaves the
group and clears its environment, too, is not found and goes on.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
import os
from pathlib import Path
import resource
import signal
import subprocess
import threading
import time
from typing import IO
import uuid

MARK = 'HUMANOID_COURSE_PROGRAM'
"""Environment variable by which descendants in sessions of their own are recognized."""
_KEPT_BYTES = 40_000
_LARGEST_FILE_BYTES = 100_000_000
"""A program that never stops writing does not fill the disk."""
_KILL_TIMEOUT_S = 10.0
_POLL_S = 0.02


class _Output:
    """The beginning and the end of a stream, which a thread reads to its end."""

    def __init__(self, stream: IO[bytes]) -> None:
        self._stream = stream
        self._lock = threading.Lock()
        self._head = b''
        self._tail = b''
        self._left_out = 0
        self._thread = threading.Thread(target=self._read, daemon=True)
        self._thread.start()

    def text(self) -> str:
        """Return what is kept of the output so far."""
        with self._lock:
            gap = f'\n[{self._left_out} bytes left out]\n'.encode() if self._left_out else b''
            return (self._head + gap + self._tail).decode(errors='replace')

    def mark(self) -> int:
        """Return how many bytes there were so far."""
        with self._lock:
            return len(self._head) + self._left_out + len(self._tail)

    def since(self, mark: int) -> str:
        """Return what is kept of the output after a mark; of a gap, no part of a line."""
        with self._lock:
            tail_start = len(self._head) + self._left_out
            skipped = max(0, mark - tail_start)
            head, tail = self._head[mark:], self._tail[skipped:]
            if self._left_out and mark < tail_start:
                head = head[: head.rfind(b'\n') + 1]
                line_start = tail.find(b'\n') + 1
                tail = tail[line_start:]
            return (head + tail).decode(errors='replace')

    def join(self, timeout_s: float) -> None:
        """Wait for the end of the stream, which a descendant may keep open."""
        self._thread.join(timeout_s)

    def _read(self) -> None:
        with self._stream, suppress(OSError, ValueError):
            while chunk := os.read(self._stream.fileno(), 65536):
                self._keep(chunk)

    def _keep(self, chunk: bytes) -> None:
        with self._lock:
            room = _KEPT_BYTES - len(self._head) if not self._tail else 0
            self._head += chunk[:room]
            self._tail += chunk[room:]
            excess = max(0, len(self._tail) - _KEPT_BYTES)
            self._tail = self._tail[excess:]
            self._left_out += excess


class Program:
    """
    A program with all that it starts, which is known by a mark in its environment.

    Parameters
    ----------
    command
        The program and its arguments.
    variables
        All of its environment variables.
    folder
        Its working directory.

    """

    def __init__(self, command: Sequence[str], variables: Mapping[str, str], folder: Path) -> None:
        self._command = command
        self._folder = folder
        self._token = uuid.uuid4().hex
        self._variables = {**variables, 'PYTHONUNBUFFERED': '1', MARK: self._token}
        self._process: subprocess.Popen[bytes] | None = None
        self._output: _Output | None = None

    def start(self) -> None:
        """Start the program."""
        self._process = subprocess.Popen(
            self._command,
            cwd=self._folder,
            env=self._variables,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
        with suppress(OSError):  # it may have ended already
            limits = (_LARGEST_FILE_BYTES, _LARGEST_FILE_BYTES)
            resource.prlimit(self._process.pid, resource.RLIMIT_FSIZE, limits)
        if self._process.stdout is not None:
            self._output = _Output(self._process.stdout)

    @property
    def output(self) -> str:
        """Return what the program has written so far: its beginning and its end."""
        return self._output.text() if self._output else ''

    def mark(self) -> int:
        """Return a mark at the end of what the program has written so far, for `since`."""
        return self._output.mark() if self._output else 0

    def since(self, mark: int) -> str:
        """
        Return what the program has written after a mark, as far as it is kept.

        Parameters
        ----------
        mark
            The mark.

        """
        return self._output.since(mark) if self._output else ''

    @property
    def status(self) -> int | None:
        """Return the exit status, or None while the program runs."""
        return self._process.poll() if self._process else None

    def wait(self, timeout_s: float) -> bool:
        """
        Wait for the end of the program.

        Parameters
        ----------
        timeout_s
            How long to wait.

        Returns
        -------
        bool
            Whether it has ended.

        """
        end_s = time.monotonic() + timeout_s
        while self.status is None:
            if time.monotonic() > end_s:
                return False
            time.sleep(_POLL_S)
        self._read_rest()
        return True

    def interrupt(self, timeout_s: float) -> tuple[str, ...]:
        """
        Interrupt the program as Ctrl-C in its terminal does, and wait for its end.

        Parameters
        ----------
        timeout_s
            How long it may take to end.

        Returns
        -------
        tuple of str
            The commands of what is still running then.

        """
        self._signal_group(signal.SIGINT)
        end_s = time.monotonic() + timeout_s
        while (left := self._members()) and time.monotonic() < end_s:
            time.sleep(_POLL_S)
        if not left:
            self._read_rest()
        return tuple(_command_of(pid) for pid in left)

    def close(self) -> None:
        """Kill what is left of the program, and wait until it is gone."""
        members = self._members()
        ending = set(members)
        self._signal_group(signal.SIGKILL)
        end_s = time.monotonic() + _KILL_TIMEOUT_S
        # A process that ends loses its environment, by which it is found, before it is gone.
        while any(map(_is_running, ending)) and time.monotonic() < end_s:
            for pid in members:
                with suppress(ProcessLookupError, PermissionError):
                    os.kill(pid, signal.SIGKILL)
            time.sleep(_POLL_S)
            members = self._members()
            ending.update(members)
        self._read_rest()

    def _signal_group(self, number: signal.Signals) -> None:
        """Send a signal to the process group, as a terminal does."""
        if self._process is not None:
            with suppress(ProcessLookupError):
                os.killpg(self._process.pid, number)

    def _read_rest(self) -> None:
        """Wait for the end of the output; what has left the group may hold it open."""
        if self._output is not None:
            self._output.join(1.0)

    def _members(self) -> list[int]:
        """Return the running processes of the program."""
        if self._process is not None:
            self._process.poll()  # so that it is no zombie
        mark = f'{MARK}={self._token}'.encode()
        found = []
        for name in os.listdir('/proc'):
            if name.isdigit() and mark in _read(f'/proc/{name}/environ').split(b'\0'):
                found.append(int(name))
        return [pid for pid in found if _is_running(pid)]


@contextmanager
def running(
    command: Sequence[str], variables: Mapping[str, str], folder: Path
) -> Iterator[Program]:
    """
    Run a program for the length of a `with` block; what it started is killed afterwards.

    Parameters
    ----------
    command, variables, folder
        As for `Program`.

    Yields
    ------
    Program
        The program.

    """
    program = Program(command, variables, folder)
    try:
        program.start()
        yield program
    finally:
        with _signals_held():
            program.close()


@contextmanager
def _signals_held() -> Iterator[None]:
    """
    Hold signals back that would interrupt the end of the programs; they are handled after.

    Blocking them is not enough: another thread may receive them, and Python handles them here.
    """
    received: list[int] = []
    before = {}
    try:
        if threading.current_thread() is threading.main_thread():
            for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
                before[number] = signal.signal(number, lambda each, _: received.append(each))
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        for each in dict.fromkeys(received):
            signal.raise_signal(each)


def _is_running(pid: int) -> bool:
    state = _read(f'/proc/{pid}/stat').rpartition(b')')[2].split()
    return bool(state) and state[0] != b'Z'


def _command_of(pid: int) -> str:
    words = _read(f'/proc/{pid}/cmdline').decode(errors='replace').split('\0')
    return ' '.join(word.rpartition('/')[2] for word in words[:3] if word) or f'process {pid}'


def _read(path: str) -> bytes:
    try:
        return Path(path).read_bytes()
    except OSError:
        return b''
