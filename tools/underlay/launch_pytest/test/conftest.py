# SPDX-License-Identifier: Apache-2.0
"""What the tests of this package share."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
import re
import subprocess
import sys

import pytest

# A shell that says hello, waits for a signal, says bye and ends in order.
HEAD = """
import asyncio
import os
import signal
from launch import LaunchDescription
from launch.actions import ExecuteProcess, OpaqueFunction, TimerAction
import launch_pytest
from launch_pytest.actions import ReadyToTest
from launch_pytest.tools import process as tools
import pytest

def talker():
    return ExecuteProcess(cached_output=True, cmd=['sh', '-c', (
        'trap "echo bye; exit 0" INT; echo hello; echo oops >&2; while :; do sleep 0.01; done')])

@launch_pytest.fixture
def it():
    process = talker()
    yield LaunchDescription([process]), process
    assert process.return_code is not None

@launch_pytest.fixture(scope='module')
def shared():
    process = talker()
    return LaunchDescription([process, ReadyToTest()]), process

def said(process, context, text='hello'):
    return tools.wait_for_output_sync(context, process, lambda output: text in output, 30)
"""


@dataclass
class Report:
    """What pytest said about a file."""

    text: str

    @property
    def outcomes(self) -> list[tuple[str, str]]:
        """Return the name and the outcome of each test, in order."""
        return re.findall(r'^test_it\.py::(\S+) ([A-Z]+)', self.text, flags=re.MULTILINE)


@pytest.fixture
def run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., Report]:
    """Return a function that runs pytest on a file."""
    monkeypatch.setenv('ROS_LOG_DIR', str(tmp_path / 'log'))

    def execute(text: str, *arguments: str) -> Report:
        (tmp_path / 'test_it.py').write_text(HEAD + text, encoding='utf-8')
        result = subprocess.run(
            [sys.executable, '-m', 'pytest', '-p', 'no:cacheprovider', '--strict-markers', '-v']
            + ['test_it.py', *arguments],
            cwd=tmp_path,
            capture_output=True,
            encoding='utf-8',
            timeout=120,
        )
        return Report(result.stdout + result.stderr)

    return execute
