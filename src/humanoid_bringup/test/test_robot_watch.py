# SPDX-License-Identifier: Apache-2.0
"""Check what happens when the robot itself ends."""

from __future__ import annotations

import os
from pathlib import Path
import re
import signal

from humanoid_bringup.robot_watch import exit_report
from humanoid_common.testing.launching import running_launch_file
from humanoid_common.testing.processes import RunningProgram
from humanoid_common.testing.ros import ros_sandbox
import pytest

LAUNCH_FILE = Path(__file__).parents[1] / 'launch' / 'bringup.launch.py'
QUIET = ('backend:=mock', 'gui:=false', 'use_controller:=false')
TIMEOUT_S = 100.0


def kill_robot(program: RunningProgram, number: signal.Signals) -> None:
    """Send a signal to the mock robot as soon as it runs."""
    program.wait_for_output('Mock robot started', TIMEOUT_S)
    found = re.search(r'\[mock_robot-\d+\]: process started with pid \[(\d+)\]', program.output)
    assert found is not None
    os.kill(int(found[1]), number)


def test_all_ends_with_the_robot() -> None:
    """When the robot is killed, the launch says so, and ends everything."""
    with ros_sandbox(), running_launch_file(LAUNCH_FILE, *QUIET) as program:
        kill_robot(program, signal.SIGKILL)
        report = program.wait_for_exit(TIMEOUT_S)
    assert re.search(
        r'The robot is gone: mock_robot-\d+ was killed by signal 9, and everything else shuts',
        report.output,
    )
    assert 'Traceback' not in report.output
    assert re.search(r'robot_state_publisher-\d+\]: process has finished cleanly', report.output)


def test_all_stays_without_the_robot() -> None:
    """If it is wanted so, the rest goes on without the robot, until Ctrl-C."""
    arguments = (*QUIET, 'when_robot_ends:=stay')
    with ros_sandbox(), running_launch_file(LAUNCH_FILE, *arguments) as program:
        kill_robot(program, signal.SIGTERM)
        program.wait_for_output(
            'has exited with status 0, and the other nodes continue', TIMEOUT_S
        )
        assert not program.has_ended
        report = program.stop(signal.SIGINT)
    assert report.output.count('The robot is gone') == 1


def test_ctrl_c_is_no_death() -> None:
    """The start of the robot is announced; when all is ended by Ctrl-C, nobody mourns."""
    with ros_sandbox(), running_launch_file(LAUNCH_FILE, *QUIET) as program:
        program.wait_for_output('The robot has started, without a page.', TIMEOUT_S)
        report = program.stop(signal.SIGINT)
    assert report.status == 0 and 'The robot is gone' not in report.output


@pytest.mark.parametrize(
    ('status', 'ends_all', 'words'),
    [
        (-9, True, "and everything else shuts down, too. To keep it running, pass 'a:"),
        (1, False, 'has exited with status 1, and the other nodes continue without it'),
    ],
)
def test_sentence(status: int, ends_all: bool, words: str) -> None:
    """The sentence says how it ended, what follows, and how to have it otherwise."""
    assert words in exit_report('simulator-1', status, ends_all, 'a')
