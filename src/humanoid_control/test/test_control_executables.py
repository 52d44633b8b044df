# SPDX-License-Identifier: Apache-2.0
"""Check how the executables start and end."""

from __future__ import annotations

import signal

from humanoid_common.testing.processes import assert_clean_exit, module_command, running_program
from humanoid_common.testing.ros import ros_sandbox
import pytest

STARTED = {
    'joint_controller': 'Humanoid Joint Controller started (50 Hz)',
    'sensor_processor': 'Sensor Processor started',
    'mock_robot': 'Mock robot started: 23 joints at 100 Hz',
}


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize('executable', STARTED)
def test_signal(executable: str, number: signal.Signals) -> None:
    """Each node starts, says so, and ends in order."""
    command = module_command(f'humanoid_control.{executable}')
    with ros_sandbox(), running_program(command) as program:
        program.wait_for_output(STARTED[executable])
        assert_clean_exit(program.stop(number))


def test_bad_parameter() -> None:
    """A bad parameter is refused in a sentence, with status 1."""
    command = module_command(
        'humanoid_control.joint_controller', '--ros-args', '-p', 'rate_hz:=0.0'
    )
    with ros_sandbox(), running_program(command) as program:
        report = program.wait_for_exit()
    assert report.status == 1 and 'Traceback' not in report.stderr
    assert "Parameter 'rate_hz' is 0.0, but must be between" in report.stderr
