# SPDX-License-Identifier: Apache-2.0
"""What the tests of this package share."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass
import os
from pathlib import Path
import subprocess
import sys
import time
from typing import Any

import launch
from launch import LaunchContext, LaunchDescription, LaunchService
import launch.logging
import pytest

LAUNCHER = """
import sys
from launch import LaunchDescription, LaunchService
from launch.actions import IncludeLaunchDescription
service = LaunchService(noninteractive=True)
service.include_launch_description(
    LaunchDescription([IncludeLaunchDescription(sys.argv[1])]))
sys.exit(service.run())
"""


@dataclass
class Result:
    """What a launch returned and wrote."""

    status: int
    text: str

    @property
    def lines(self) -> list[str]:
        """Return what was written behind the two lines that each launch begins with."""
        return self.text.splitlines()[2:]


def _wait_until(predicate: Callable[[], Any], timeout: float = 100.0, message: Any = '') -> None:
    """Wait; a message may be what returns it when it is needed."""
    end = time.monotonic() + timeout
    while not predicate():
        if time.monotonic() > end:
            text = message() if callable(message) else message
            pytest.fail(f'not within {timeout} s: {text or predicate}')
        time.sleep(0.01)


@pytest.fixture
def wait_until() -> Callable[..., None]:
    """Return a function that waits for a predicate, and fails if that takes too long."""
    return _wait_until


@pytest.fixture(autouse=True)
def _own_state(tmp_path: Path) -> Iterator[None]:
    """Give each test a log folder, a log and an environment of its own."""
    before = dict(os.environ)
    os.environ['ROS_LOG_DIR'] = str(tmp_path / 'log')
    os.environ.pop('OVERRIDE_LAUNCH_PROCESS_OUTPUT', None)
    launch.logging.reset()
    yield
    launch.logging.reset()
    os.environ.clear()
    os.environ.update(before)


def children() -> set[str]:
    """Return the children of this process, those too that ended and nobody has waited for."""
    while True:
        with suppress(FileNotFoundError, ProcessLookupError):  # a thread has ended
            return {
                pid
                for thread in Path('/proc/self/task').iterdir()
                for pid in (thread / 'children').read_text().split()
            }


@pytest.fixture
def no_child_is_left() -> Iterator[None]:
    """Fail if a test leaves a child behind; those of other tests' fixtures may be there."""
    before = children()
    yield
    assert children() <= before


@pytest.fixture
def context() -> LaunchContext:
    """Return a context that no service runs."""
    return LaunchContext()


@pytest.fixture
def run(capfd: pytest.CaptureFixture[str]) -> Callable[..., Result]:
    """Return a function that launches some entities."""

    def launch_entities(*entities: Any, **kwargs: Any) -> Result:
        service = LaunchService(**kwargs)
        service.include_launch_description(LaunchDescription(entities))
        capfd.readouterr()
        status = service.run()
        return Result(status, capfd.readouterr().out)

    return launch_entities


@pytest.fixture
def write(tmp_path: Path) -> Callable[[str, str], str]:
    """Return a function that writes a file and returns its path."""

    def write_file(name: str, text: str) -> str:
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding='utf-8')
        return str(path)

    return write_file


@pytest.fixture
def launch_command() -> list[str]:
    """Return the command that launches the file whose path follows it."""
    return [sys.executable, '-c', LAUNCHER]


class Launcher:
    """A launch in a process of its own."""

    def __init__(self, path: str, output: Path) -> None:
        """Start the launch of a file."""
        self.output = output
        with open(output, 'wb') as file:
            self.process = subprocess.Popen(
                [sys.executable, '-c', LAUNCHER, path],
                stdout=file,
                stderr=subprocess.STDOUT,
                stdin=subprocess.DEVNULL,
            )

    @property
    def text(self) -> str:
        """Return what it has written so far."""
        return self.output.read_text(encoding='utf-8', errors='replace')

    def wait_for(self, text: str) -> None:
        """Wait until it has written a text."""
        _wait_until(lambda: text in self.text or self.process.poll() is not None)
        assert text in self.text

    def end(self) -> int:
        """Return its exit status when it has ended."""
        return self.process.wait(100)


@pytest.fixture
def launcher(
    tmp_path: Path,
    write: Callable[[str, str], str],
) -> Iterator[Callable[[str], Launcher]]:
    """Return a function that launches, in another process, the entities that a text lists."""
    started: list[Launcher] = []

    def start(entities: str) -> Launcher:
        path = write(
            'it.launch.py',
            (
                'from launch import LaunchDescription, substitutions\n'
                'from launch.actions import *\n'
                f'def generate_launch_description():\n    return LaunchDescription([{entities}])\n'
            ),
        )
        started.append(Launcher(path, tmp_path / 'output'))
        return started[-1]

    yield start
    for each in started:
        each.process.kill()
        each.process.wait()
