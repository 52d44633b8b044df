# SPDX-License-Identifier: Apache-2.0
"""Launch tests of ROS nodes with pytest, and filters of what nodes write."""

from __future__ import annotations

import os
from pathlib import Path
import subprocess
import sys

from launch_testing_ros.pytest.launch_ros_test_module import isolated_domain
from launch_testing_ros.tools import basic_output_filter
import pytest

SAMPLE = """
import os
import unittest
from launch import LaunchDescription
from launch.actions import ExecuteProcess
from launch_testing.actions import ReadyToTest
from launch_testing.util import KeepAliveProc
import pytest

@pytest.mark.rostest
def generate_test_description():
    echo = ExecuteProcess(cmd=['sh', '-c', 'echo domain $ROS_DOMAIN_ID'])
    return LaunchDescription([echo, KeepAliveProc(), ReadyToTest()])

class TestIt(unittest.TestCase):
    def test_domain(self, proc_output):
        proc_output.assertWaitFor('domain ' + os.environ['ROS_DOMAIN_ID'], timeout=100)
"""


def test_pytest(tmp_path: Path) -> None:
    """A marked file runs in a domain that it got for itself."""
    (tmp_path / 'test_sample.py').write_text(SAMPLE)
    environment = {**os.environ, 'ROS_LOG_DIR': str(tmp_path / 'log')}
    result = subprocess.run(
        [sys.executable, '-m', 'pytest', '-p', 'no:cacheprovider', '--strict-markers', '.'],
        cwd=tmp_path,
        env=environment,
        capture_output=True,
        encoding='utf-8',
        timeout=120,
    )
    assert '1 passed' in result.stdout, result.stdout


def test_domain(monkeypatch: pytest.MonkeyPatch) -> None:
    """A domain is reserved for a block, unless the user wants none; two differ."""
    monkeypatch.setenv('ROS_DOMAIN_ID', 'mine')
    monkeypatch.delenv('ROS_AUTOMATIC_DISCOVERY_RANGE', raising=False)
    with isolated_domain():
        first = int(os.environ['ROS_DOMAIN_ID'])
        assert os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] == 'LOCALHOST'
        with isolated_domain():
            assert int(os.environ['ROS_DOMAIN_ID']) != first
    assert os.environ['ROS_DOMAIN_ID'] == 'mine'
    assert 'ROS_AUTOMATIC_DISCOVERY_RANGE' not in os.environ
    monkeypatch.setenv('DISABLE_ROS_ISOLATION', '1')
    with isolated_domain():
        assert os.environ['ROS_DOMAIN_ID'] == 'mine'


def test_rclpy_is_not_imported() -> None:
    """The package and its plugin do without rclpy until a node is needed."""
    code = (
        'import sys, launch_testing_ros.pytest.hooks, launch_testing_ros.tools;'
        'sys.exit("rclpy" in sys.modules)'
    )
    assert subprocess.run([sys.executable, '-c', code]).returncode == 0


def test_filter() -> None:
    """Lines by prefix and by pattern are dropped, and those of a middleware."""
    keep = basic_output_filter(['x'], ['.*ros2cli'], 'rmw_connextdds')
    assert keep('x\na ros2cli\nRTI Data Distribution Service\nb\n') == 'b\n'
