# SPDX-License-Identifier: Apache-2.0
"""Programs that tests start, watch and end, with everything that these start in turn."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
import os
from pathlib import Path
import signal
import subprocess
import time
from typing import Any
import uuid

from leftovers import members

MARK = 'STARTED_BY_TEST'


class Program:
    """A program whose whole output is kept and whose descendants are known by a mark."""

    def __init__(
        self, command: list[str], output: Path, env: dict[str, str] | None = None
    ) -> None:
        """Start it; its output goes to the file."""
        self._output = output
        self._mark = f'{MARK}={uuid.uuid4().hex}'
        name, _, value = self._mark.partition('=')
        with output.open('wb') as stream:
            self.process = subprocess.Popen(
                command,
                env={**(os.environ if env is None else env), name: value},
                stdin=subprocess.DEVNULL,
                stdout=stream,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )

    @property
    def has_ended(self) -> bool:
        """Tell whether it has ended."""
        return self.process.poll() is not None

    @property
    def output(self) -> str:
        """Return what it printed so far."""
        return self._output.read_text(errors='replace')

    def wait_for(self, text: str, timeout_s: float = 100.0) -> None:
        """Wait until it prints a text; one that has ended without it fails at once."""
        self._wait(lambda: text in self.output or self.has_ended, timeout_s, f'{text!r} in')
        assert text in self.output, f'it ended without {text!r}:\n{self.output}'

    def end(self, number: int = signal.SIGINT, timeout_s: float = 100.0) -> int:
        """Send it a signal and wait for its end; return the exit status."""
        self.process.send_signal(number)
        self._wait(lambda: self.has_ended, timeout_s, 'the end of')
        return self.process.returncode

    def members(self) -> list[int]:
        """Return it and its descendants, as far as they run."""
        return members(self._mark)

    def clean_up(self) -> None:
        """Interrupt the program, and kill whatever is left.

        What is killed may hold a lock in the memory that it shares with the nodes of a test.
        """
        self.process.send_signal(signal.SIGINT)
        with suppress(subprocess.TimeoutExpired):
            self.process.wait(5.0)
        for pid in self.members():
            os.kill(pid, signal.SIGKILL)
        self.process.wait()

    def _wait(self, done: Callable[[], bool], timeout_s: float, what: str) -> None:
        wait_until(done, timeout_s, lambda: f'{what} the output\n{self.output}')


def wait_until(done: Callable[[], Any], timeout_s: float, what: str | Callable[[], str]) -> None:
    """Wait until a condition holds."""
    end_s = time.monotonic() + timeout_s
    while not done():
        text = what if isinstance(what, str) else what()
        assert time.monotonic() < end_s, f'waited {timeout_s} s in vain for {text}'
        time.sleep(0.02)
