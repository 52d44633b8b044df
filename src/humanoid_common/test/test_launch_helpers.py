# SPDX-License-Identifier: Apache-2.0
"""Check how tests run and inspect launch files."""

from __future__ import annotations

from pathlib import Path

from humanoid_common.testing.launching import (
    argument_defaults,
    load_launch_file,
    running_launch_file,
    undescribed_arguments,
)
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
