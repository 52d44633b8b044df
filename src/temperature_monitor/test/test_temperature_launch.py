# SPDX-License-Identifier: Apache-2.0
"""Check the launch file."""

from __future__ import annotations

from pathlib import Path
import unittest

from humanoid_common.testing.launching import assert_clean_end, description_under_test
from launch import LaunchDescription
from launch_testing import ActiveIoHandler, IoHandler, post_shutdown_test, ProcInfoHandler
import pytest

LAUNCH_FILE = Path(__file__).parents[1] / 'launch' / 'temperature_monitor.launch.py'


@pytest.mark.rostest
def generate_test_description() -> LaunchDescription:
    """Launch both nodes."""
    return description_under_test(LAUNCH_FILE)


class TestRun(unittest.TestCase):
    """While both nodes run."""

    def test_output(self, proc_output: ActiveIoHandler) -> None:
        """Both nodes start with their numbers."""
        for text in (
            '[temp_publisher]: Publishing the temperature (1 Hz)',
            '[temp_analyzer]: Watching for temperatures above 25 °C',
        ):
            proc_output.assertWaitFor(text, timeout=100)


@post_shutdown_test()
class TestEnd(unittest.TestCase):
    """After Ctrl-C."""

    def test_end(self, proc_info: ProcInfoHandler, proc_output: IoHandler) -> None:
        """Both nodes end in order."""
        assert_clean_end(proc_info, proc_output)
