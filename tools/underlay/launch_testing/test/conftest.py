# SPDX-License-Identifier: Apache-2.0
"""What the tests of this package share."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib.util import module_from_spec, spec_from_file_location
import io
import os
from pathlib import Path
import subprocess
import sys
from types import ModuleType
from typing import Any

from launch.actions import ExecuteProcess
from launch.events.process import ProcessExited, ProcessStarted, ProcessStderr, ProcessStdout
import launch.logging
from launch_testing.loader import LoadTestsFromPythonModule
from launch_testing.test_result import TestResult
from launch_testing.test_runner import SingleRun
import pytest

# A shell that says hello, waits for a signal, says bye and ends in order.
TALKER = (
    "ExecuteProcess(name='talker', cmd=['sh', '-c', "
    '\'trap "echo bye; exit 0" INT; echo hello; echo oops >&2; while :; do sleep 0.01; done\'])'
)
HEAD = """
import unittest
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess, OpaqueFunction, TimerAction
from launch.substitutions import LaunchConfiguration
import launch_testing
from launch_testing.actions import ReadyToTest
from launch_testing.asserts import *
from launch_testing.util import KeepAliveProc
import pytest
"""


@pytest.fixture(autouse=True)
def _own_log(tmp_path: Path) -> Iterator[None]:
    """Give each test a log folder of its own."""
    before = os.environ.get('ROS_LOG_DIR')
    os.environ['ROS_LOG_DIR'] = str(tmp_path / 'log')
    launch.logging.reset()
    yield
    launch.logging.reset()
    if before is None:
        del os.environ['ROS_LOG_DIR']
    else:
        os.environ['ROS_LOG_DIR'] = before


class FakeProcess(ExecuteProcess):
    """A process as its tests see it."""

    def __init__(self, name: str, *arguments: str) -> None:
        """Create a process that never runs."""
        super().__init__(cmd=[name, *arguments])
        self.process_facts = {'name': name, 'cmd': [name, *arguments], 'cwd': None, 'env': None}

    @property
    def process_details(self) -> dict[str, Any]:
        """Return the facts about the process."""
        return self.process_facts

    def started(self) -> ProcessStarted:
        """Return the event of its start."""
        return ProcessStarted(action=self, pid=1, **self.process_facts)

    def exited(self, code: int) -> ProcessExited:
        """Return the event of its end."""
        return ProcessExited(action=self, pid=1, returncode=code, **self.process_facts)

    def wrote(self, text: str, stream: int = 1) -> ProcessStdout:
        """Return the event of its output."""
        event = ProcessStdout if stream == 1 else ProcessStderr
        return event(action=self, pid=1, text=text.encode(), **self.process_facts)


@pytest.fixture
def fake_process() -> type[FakeProcess]:
    """Return the class of processes that never run."""
    return FakeProcess


@pytest.fixture
def launch_file(tmp_path: Path) -> Callable[..., Path]:
    """Return a function that writes a launch test file."""

    def write(text: str, name: str = 'sample_launch.py') -> Path:
        path = tmp_path / name
        path.write_text(HEAD + text.replace('TALKER', TALKER), encoding='utf-8')
        return path

    return write


@pytest.fixture
def module(launch_file: Callable[..., Path]) -> Callable[[str], ModuleType]:
    """Return a function that makes a module of a launch test."""

    def load(text: str) -> ModuleType:
        spec = spec_from_file_location('sample_launch', launch_file(text))
        assert spec is not None and spec.loader is not None
        result = module_from_spec(spec)
        spec.loader.exec_module(result)
        return result

    return load


@dataclass
class Run:
    """What became of a launch test."""

    result: TestResult
    text: str

    @property
    def outcomes(self) -> list[tuple[str, str]]:
        """Return the name and the outcome of each test."""
        return [(each.name, each.outcome) for each in self.result.outcomes]


@pytest.fixture
def run(module: Callable[[str], ModuleType]) -> Callable[..., Run]:
    """Return a function that runs a launch test once."""

    def execute(text: str, *arguments: str, **options: Any) -> Run:
        (test_run,) = LoadTestsFromPythonModule(module(text), name='sample')
        stream = io.StringIO()
        result = SingleRun(test_run, arguments, stream=stream, **options).execute()
        return Run(result, stream.getvalue())

    return execute


@pytest.fixture
def command(tmp_path: Path) -> Callable[..., subprocess.CompletedProcess[str]]:
    """Return a function that runs a Python module as a program."""

    def execute(*arguments: object) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [sys.executable, '-m', *map(str, arguments)],
            cwd=tmp_path,
            capture_output=True,
            encoding='utf-8',
            timeout=120,
        )

    return execute
