# SPDX-License-Identifier: Apache-2.0
"""Check the launch file of both nodes."""

from __future__ import annotations

from pathlib import Path

from humanoid_common.testing.launching import (
    argument_defaults,
    load_launch_file,
    running_launch_file,
    undescribed_arguments,
)
from humanoid_common.testing.ros import ros_sandbox

LAUNCH_FILE = Path(__file__).parents[1] / 'launch' / 'robot_bringup.launch.py'


def test_arguments() -> None:
    """Every argument has a default and a description."""
    description = load_launch_file(LAUNCH_FILE)
    assert argument_defaults(description) == {
        'report_period_s': '1.0',
        'use_controller': 'true',
        'use_sim_time': 'false',
    }
    assert undescribed_arguments(description) == []


def test_misspelt_choice() -> None:
    """A value outside the choices is refused."""
    with ros_sandbox(), running_launch_file(LAUNCH_FILE, 'use_controller:=yes') as program:
        report = program.wait_for_exit()
    assert report.status == 1 and "['true', 'false']" in report.output
