# SPDX-License-Identifier: Apache-2.0
"""Check how tests run and inspect launch files."""

from __future__ import annotations

from pathlib import Path
import signal
import sys
from types import SimpleNamespace
from typing import Any

from humanoid_common.testing.launching import (
    argument_defaults,
    assert_clean_end,
    description_under_test,
    load_launch_file,
    running_launch_file,
    undescribed_arguments,
)
from humanoid_common.testing.processes import running_program
from humanoid_common.testing.waiting import wait_until
from launch_testing import ProcInfoHandler
import pytest

FILE = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess
from launch.substitutions import LaunchConfiguration

def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('word', default_value='hello', description='A word.'),
        DeclareLaunchArgument('silent', default_value=''),
        ExecuteProcess(cmd=['echo', 'said', LaunchConfiguration('word')], output='screen'),
    ])
"""

WAITS = """
from launch import LaunchDescription
from launch.actions import ExecuteProcess

def generate_launch_description():
    script = 'trap "touch FILE; exit" INT; echo ready; while :; do sleep 0.1; done'
    return LaunchDescription([ExecuteProcess(cmd=['bash', '-c', script], output='screen')])
"""
CALLER = """
from pathlib import Path
import sys
from humanoid_common.testing.launching import running_launch_file

with running_launch_file(Path(sys.argv[1])) as program:
    program.wait_for_output('ready')
    print('it runs')
    program.wait_for_exit()
"""


@pytest.fixture(name='path')
def _path(tmp_path: Path) -> Path:
    """Write a launch file."""
    path = tmp_path / 'sample.launch.py'
    path.write_text(FILE, encoding='utf-8')
    return path


def test_inspection(path: Path) -> None:
    """Arguments, their defaults and missing descriptions are found."""
    description = load_launch_file(path)
    assert argument_defaults(description) == {'word': 'hello', 'silent': ''}
    assert undescribed_arguments(description) == ['silent']


def test_run(path: Path) -> None:
    """A launch file runs with its arguments until it has nothing left to do."""
    with running_launch_file(path, 'word:=bye') as program:
        report = program.wait_for_exit()
    assert report.status == 0 and 'said bye' in report.output


@pytest.mark.parametrize('number', [signal.SIGTERM, signal.SIGKILL])
def test_end_with_the_caller(tmp_path: Path, number: signal.Signals) -> None:
    """A launch file is interrupted when the program that runs it is ended or killed."""
    ended = tmp_path / 'ended'
    path = tmp_path / 'waits.launch.py'
    path.write_text(WAITS.replace('FILE', str(ended)), encoding='utf-8')
    caller = (sys.executable, '-c', CALLER, str(path))
    with running_program(caller) as program:
        program.wait_for_output('it runs')
        program.send(number)
        program.wait_for_exit()
        wait_until(ended.exists, 30.0, lambda: 'the launched process to be interrupted')


def test_description_under_test(path: Path) -> None:
    """A launch test includes the file, and may begin then."""
    entities = description_under_test(path, word='bye').entities
    assert [type(each).__name__ for each in entities] == [
        'IncludeLaunchDescription',
        'ReadyToTest',
    ]


def test_traceback_is_no_clean_end() -> None:
    """A traceback counts, although the status may be 0."""
    output: Any = [SimpleNamespace(process_name='node-1', text=b'hello')]
    assert_clean_end(ProcInfoHandler(), output)
    output.append(SimpleNamespace(process_name='node-2', text=b'Traceback (most recent call'))
    with pytest.raises(AssertionError, match='node-2'):
        assert_clean_end(ProcInfoHandler(), output)
