# SPDX-License-Identifier: Apache-2.0
"""Check the launch file."""

from __future__ import annotations

from pathlib import Path
import signal

from humanoid_common.testing.launching import running_launch_file
from humanoid_common.testing.ros import ros_sandbox

LAUNCH_FILE = Path(__file__).parents[1] / 'launch' / 'temperature_monitor.launch.py'


def test_run() -> None:
    """Both nodes start with their numbers, and end with Ctrl-C."""
    with ros_sandbox(), running_launch_file(LAUNCH_FILE) as program:
        program.wait_for_output('[temp_publisher]: Publishing the temperature (1 Hz)')
        program.wait_for_output('[temp_analyzer]: Watching for temperatures above 25 °C')
        report = program.stop(signal.SIGINT)
    assert report.status == 0 and 'Traceback' not in report.output
