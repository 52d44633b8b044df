# SPDX-License-Identifier: Apache-2.0
"""Check the launch file."""

from __future__ import annotations

from pathlib import Path
import unittest

from humanoid_common.testing.launching import assert_clean_end, description_under_test
from launch import LaunchDescription
from launch_testing import ActiveIoHandler, IoHandler, post_shutdown_test, ProcInfoHandler
import pytest

LAUNCH_FILE = Path(__file__).parents[1] / 'launch' / 'robot_control.launch.py'


@pytest.mark.rostest
def generate_test_description() -> LaunchDescription:
    """Launch the node."""
    return description_under_test(LAUNCH_FILE)


class TestRun(unittest.TestCase):
    """While the node runs."""

    def test_output(self, proc_output: ActiveIoHandler) -> None:
        """The launch file hands the model over."""
        text = 'elbow: revolute, upper_arm -> forearm, -2.3 to 2.3 rad'
        proc_output.assertWaitFor(text, timeout=100)


@post_shutdown_test()
class TestEnd(unittest.TestCase):
    """After Ctrl-C."""

    def test_end(self, proc_info: ProcInfoHandler, proc_output: IoHandler) -> None:
        """The node ends in order."""
        assert_clean_end(proc_info, proc_output)
