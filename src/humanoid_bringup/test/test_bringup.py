# SPDX-License-Identifier: Apache-2.0
"""Check the launch file of the whole humanoid."""

from __future__ import annotations

from pathlib import Path
import signal

from humanoid_common.testing.launching import (
    argument_defaults,
    load_launch_file,
    running_launch_file,
    undescribed_arguments,
)
from humanoid_common.testing.ros import ros_sandbox
import pytest

LAUNCH_FILE = Path(__file__).parents[1] / 'launch' / 'bringup.launch.py'


def test_arguments() -> None:
    """Every argument has a default and a description."""
    description = load_launch_file(LAUNCH_FILE)
    assert argument_defaults(description) == {'use_controller': 'true', 'use_sim_time': 'false'}
    assert undescribed_arguments(description) == []


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_run(number: signal.Signals) -> None:
    """The humanoid moves its arms until a signal ends everything."""
    with ros_sandbox(), running_launch_file(LAUNCH_FILE) as program:
        program.wait_for_output('[sensor_processor]: left_shoulder: ')
        report = program.stop(number)
    assert report.status == 0 and 'Traceback' not in report.output


def test_without_controller() -> None:
    """The argument reaches the included file: no controller is started."""
    with ros_sandbox(), running_launch_file(LAUNCH_FILE, 'use_controller:=false') as program:
        program.wait_for_output('Sensor Processor started')
        report = program.stop(signal.SIGINT)
    assert report.status == 0 and 'joint_controller' not in report.output
