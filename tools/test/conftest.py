# SPDX-License-Identifier: Apache-2.0
"""What the tests of the tools share."""

from __future__ import annotations

from collections.abc import Callable, Iterator
import os
from pathlib import Path
import signal
import subprocess
import sys
import time

from domain_coordinator import domain_id
import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / 'tools' / 'setup'))


@pytest.fixture
def root() -> Path:
    """Return the workspace's folder."""
    return ROOT


@pytest.fixture
def own_domain(monkeypatch: pytest.MonkeyPatch) -> Iterator[int]:
    """Reserve a DDS domain, on this machine only, for the programs that a test starts."""
    with domain_id() as number:
        monkeypatch.setenv('ROS_DOMAIN_ID', str(number))
        monkeypatch.setenv('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
        yield number


class Program:
    """A program in a session of its own, whose whole output is kept."""

    def __init__(self, command: list[str], output: Path, **options: object) -> None:
        """Start it; its output goes to the file."""
        self._output = output
        with output.open('wb') as stream:
            self.process = subprocess.Popen(
                command,
                stdin=subprocess.DEVNULL,
                stdout=stream,
                stderr=subprocess.STDOUT,
                start_new_session=True,
                **options,  # type: ignore[call-overload]
            )

    @property
    def output(self) -> str:
        """Return what it printed so far."""
        return self._output.read_text(errors='replace')

    def wait_for(self, text: str, timeout_s: float = 60.0) -> None:
        """Wait until it prints a text."""
        self._wait(lambda: text in self.output, timeout_s, f'did not print {text!r}')

    def end(self, number: int = signal.SIGINT, timeout_s: float = 20.0) -> int:
        """Send it a signal and wait for its end; return the exit status."""
        self.process.send_signal(number)
        self._wait(lambda: self.process.poll() is not None, timeout_s, 'did not end')
        return self.process.returncode

    def members(self) -> list[int]:
        """Return the processes of its session."""
        return [pid for pid in _processes() if _session(pid) == self.process.pid]

    def clean_up(self) -> None:
        """Kill whatever is left of its session."""
        for pid in self.members():
            os.kill(pid, signal.SIGKILL)
        self.process.wait()

    def _wait(self, done: Callable[[], bool], timeout_s: float, complaint: str) -> None:
        end_s = time.monotonic() + timeout_s
        while not done():
            assert time.monotonic() < end_s, f'{complaint} in {timeout_s} s:\n{self.output}'
            time.sleep(0.02)


def _processes() -> list[int]:
    return [int(name) for name in os.listdir('/proc') if name.isdigit()]


def _session(pid: int) -> int | None:
    try:
        return os.getsid(pid)
    except ProcessLookupError:
        return None


@pytest.fixture
def start(tmp_path: Path) -> Iterator[Callable[..., Program]]:
    """Return a function that starts a program, which ends with the test at the latest."""
    programs: list[Program] = []

    def _start(*command: str, **options: object) -> Program:
        output = tmp_path / f'output-{len(programs)}.txt'
        programs.append(Program(list(command), output, **options))
        return programs[-1]

    yield _start
    for program in programs:
        program.clean_up()
