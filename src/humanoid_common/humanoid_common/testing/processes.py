# SPDX-License-Identifier: Apache-2.0
"""Run a program, read its output while it runs, signal it, and leave no process behind."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
import os
from pathlib import Path
import signal
import subprocess
import sys
import threading
from typing import IO

from humanoid_common.testing.waiting import wait_until

_GRACE_S = 10.0
"""Time that a program is given to end after SIGINT."""


class Capture:
    """
    Collector of the output of a stream, as text, in a thread of its own.

    Parameters
    ----------
    stream
        The stream to read, from now on; it is closed at its end.

    Raises
    ------
    ValueError
        There is no stream.

    """

    def __init__(self, stream: IO[bytes] | None) -> None:
        if stream is None:
            raise ValueError('There is no stream to read: start the program with pipes.')
        self._stream = stream
        self._chunks: list[bytes] = []
        self._thread = threading.Thread(target=self._read, daemon=True)
        self._thread.start()

    @property
    def text(self) -> str:
        """Return the output so far."""
        return b''.join(self._chunks).decode(errors='replace')

    def join(self, timeout_s: float) -> None:
        """
        Wait until the stream has ended.

        Parameters
        ----------
        timeout_s
            Maximum time to wait.

        """
        self._thread.join(timeout_s)

    def _read(self) -> None:
        """Read line by line until the end."""
        with self._stream:
            for line in self._stream:
                self._chunks.append(line)


@dataclass(frozen=True)
class ExitReport:
    """Exit status and output of a program."""

    status: int
    stdout: str
    stderr: str

    @property
    def output(self) -> str:
        """Return both streams, first stdout."""
        return self.stdout + self.stderr


class RunningProgram:
    """
    A program under test, in a process group of its own.

    Parameters
    ----------
    command
        The program and its arguments; it starts at once.
    environment
        Environment variables, added to those of this process.

    """

    def __init__(self, command: Sequence[str], environment: Mapping[str, str] = {}) -> None:
        self._command = list(command)
        self._process = subprocess.Popen(
            self._command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            start_new_session=True,
            env={**os.environ, 'PYTHONUNBUFFERED': '1', **environment},
        )
        self._stdout = Capture(self._process.stdout)
        self._stderr = Capture(self._process.stderr)

    @property
    def output(self) -> str:
        """Return the output on both streams so far."""
        return self._stdout.text + self._stderr.text

    @property
    def pid(self) -> int:
        """Return the process id."""
        return self._process.pid

    @property
    def has_ended(self) -> bool:
        """Whether the program has ended."""
        return self._process.poll() is not None

    def wait_for_output(self, text: str, timeout_s: float = 60.0) -> None:
        """
        Wait until a text appears on stdout or stderr.

        Parameters
        ----------
        text
            What to wait for.
        timeout_s
            Real time to wait; if the program ends, no more than another second.

        Raises
        ------
        WaitedInVainError
            The text did not appear in time.

        """
        wait_until(
            lambda: text in self.output or self.has_ended,
            timeout_s,
            lambda: f'{text!r} from {self._command}; it wrote: {self.output}',
        )
        wait_until(
            lambda: text in self.output,
            1.0,
            lambda: f'{text!r} from {self._command}, which exited; it wrote: {self.output}',
        )

    def send(self, number: signal.Signals) -> None:
        """
        Send a signal to the program itself, not to its process group.

        Parameters
        ----------
        number
            The signal.

        """
        self._process.send_signal(number)

    def wait_for_exit(self, timeout_s: float = 60.0) -> ExitReport:
        """
        Wait until the program has ended and all its output has been read.

        Parameters
        ----------
        timeout_s
            Real time to wait for the end.

        Returns
        -------
        ExitReport
            Its exit status and its output.

        Raises
        ------
        WaitedInVainError
            The program is still running then.

        """
        wait_until(
            lambda: self.has_ended,
            timeout_s,
            lambda: f'{self._command} to exit; it wrote: {self.output}',
        )
        self._stdout.join(timeout_s)
        self._stderr.join(timeout_s)
        return ExitReport(self._process.returncode, self._stdout.text, self._stderr.text)

    def stop(self, number: signal.Signals, timeout_s: float = 60.0) -> ExitReport:
        """
        Send a signal to the program, and wait for its end.

        Parameters
        ----------
        number, timeout_s
            As for `send` and `wait_for_exit`.

        Returns
        -------
        ExitReport
            As for `wait_for_exit`.

        """
        self.send(number)
        return self.wait_for_exit(timeout_s)

    def close(self) -> None:
        """
        End the program, and kill its process group and all its descendants outside of it.

        It is killed only if it does not heed SIGINT: a killed node may hold a lock in the shared
        memory through which DDS writes to the nodes of the test, whose process then dies as well.
        """
        started = [] if self.has_ended else _descendants(self._process.pid)
        if not self.has_ended:
            self.send(signal.SIGINT)
            with suppress(subprocess.TimeoutExpired):
                self._process.wait(_GRACE_S)
        with suppress(ProcessLookupError):
            os.killpg(self._process.pid, signal.SIGKILL)
        self._process.wait()
        for pid in started:
            with suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        # A node that survives would be in the domain of the next test.
        wait_until(
            lambda: not any(map(is_alive, started)),
            60.0,
            lambda: f'all processes of {self._command} to exit',
        )


@contextmanager
def running_program(
    command: Sequence[str],
    environment: Mapping[str, str] = {},
) -> Iterator[RunningProgram]:
    """
    Run a command for the length of a `with` block.

    Parameters
    ----------
    command
        The program and its arguments.
    environment
        Environment variables, added to those of this process.

    Yields
    ------
    RunningProgram
        The program; it is ended after the block, with all processes that it started.

    """
    program = RunningProgram(command, environment)
    try:
        yield program
    finally:
        program.close()


def _descendants(pid: int) -> list[int]:
    """Find the ids of all descendants of a process."""
    parents = {}
    for folder in Path('/proc').glob('[0-9]*'):
        with suppress(OSError):
            parents[int(folder.name)] = int(_stat_of(folder)[1])
    found = [pid]
    for ancestor in found:  # grows during the loop
        found.extend(child for child, parent in parents.items() if parent == ancestor)
    return found[1:]


def is_alive(pid: int) -> bool:
    """
    Check whether a process exists and is not a zombie.

    Parameters
    ----------
    pid
        Id of the process.

    """
    try:
        return _stat_of(Path(f'/proc/{pid}'))[0] != 'Z'
    except OSError:
        return False


def _stat_of(folder: Path) -> list[str]:
    """Read the fields of /proc/PID/stat, starting with the state."""
    return (folder / 'stat').read_text().rpartition(')')[2].split()


def module_command(module: str, *arguments: str) -> list[str]:
    """
    Build the command that runs a module with the Python interpreter of this process.

    Parameters
    ----------
    module
        Name of the module, as for `python3 -m`.
    *arguments
        Its command line arguments.

    """
    return [sys.executable, '-m', module, *arguments]


def assert_clean_exit(report: ExitReport) -> None:
    """
    Assert that a node ended cleanly: status 0, and nothing on stderr but log lines.

    Parameters
    ----------
    report
        Exit report of its program.

    Raises
    ------
    AssertionError
        It ended otherwise; the message contains the output.

    """
    noise = [line for line in report.stderr.splitlines() if line and not line.startswith('[')]
    assert not noise, f'the program wrote more than log lines on stderr:\n{report.stderr}'
    assert report.status == 0, f'status {report.status}:\n{report.output}'
