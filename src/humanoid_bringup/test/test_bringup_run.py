# SPDX-License-Identifier: Apache-2.0
"""Check what the launch file starts."""

from __future__ import annotations

from pathlib import Path
import unittest

from humanoid_common.testing.launching import assert_clean_end, description_under_test
from launch import LaunchDescription
from launch_testing import (
    ActiveIoHandler,
    IoHandler,
    parametrize,
    post_shutdown_test,
    ProcInfoHandler,
)
import pytest

LAUNCH_FILE = Path(__file__).parents[1] / 'launch' / 'bringup.launch.py'

ROBOT = "Robot 'humanoid'"
STARTED = {'mujoco': 'Simulator started: one robot', 'mock': 'Mock robot started'}
REPORT = '[sensor_processor]: left_shoulder: '
ALONE = 'Sensor Processor started'


@pytest.mark.rostest
@parametrize(('use_controller', 'backend'), [('true', 'mujoco'), ('false', 'mock')])
def generate_test_description(use_controller: str, backend: str) -> LaunchDescription:
    """Launch the humanoid, with and without physics, with and without its controller."""
    return description_under_test(LAUNCH_FILE, backend=backend, use_controller=use_controller)


class TestRun(unittest.TestCase):
    """While it runs."""

    def test_output(self, proc_output: ActiveIoHandler, use_controller: str, backend: str) -> None:
        """The processor reports what the controller sends, and runs without it, too."""
        proc_output.assertWaitFor(REPORT if use_controller == 'true' else ALONE, timeout=100)
        proc_output.assertWaitFor(ROBOT, process='robot_state_publisher', timeout=100)
        proc_output.assertWaitFor(STARTED[backend], timeout=100)


@post_shutdown_test()
class TestEnd(unittest.TestCase):
    """After Ctrl-C."""

    def test_processes(self, proc_info: ProcInfoHandler, use_controller: str) -> None:
        """The controller was there only if it was wanted, and joints had one publisher."""
        controllers = [name for name in proc_info.process_names() if 'controller' in name]
        assert len(controllers) == (use_controller == 'true')
        assert not [name for name in proc_info.process_names() if 'joint_state_pub' in name]

    def test_end(self, proc_info: ProcInfoHandler, proc_output: IoHandler) -> None:
        """All nodes end in order."""
        assert_clean_end(proc_info, proc_output)
