# SPDX-License-Identifier: Apache-2.0
"""Check the launch file of the whole humanoid."""

from __future__ import annotations

from pathlib import Path

from humanoid_common.testing.launching import (
    argument_defaults,
    load_launch_file,
    undescribed_arguments,
)

LAUNCH_FILE = Path(__file__).parents[1] / 'launch' / 'bringup.launch.py'


def test_arguments() -> None:
    """Every argument has a default and a description."""
    description = load_launch_file(LAUNCH_FILE)
    assert argument_defaults(description) == {
        'backend': 'mujoco',
        'gui': 'true',
        'manipulation': 'false',
        'navigation': 'false',
        'perception': 'false',
        'qr_code': 'auto',
        'report_period_s': '3600.0',
        'use_controller': 'true',
        'use_sim_time': 'auto',
        'when_robot_ends': 'shutdown',
    }
    assert undescribed_arguments(description) == []
