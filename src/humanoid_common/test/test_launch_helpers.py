# SPDX-License-Identifier: Apache-2.0
"""Check how tests run and inspect launch files."""

from __future__ import annotations

from pathlib import Path
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
