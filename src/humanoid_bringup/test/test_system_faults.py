# SPDX-License-Identifier: Apache-2.0
"""Check that the robot stays on its feet whatever ends beside it, and what its own end does."""

from __future__ import annotations

from collections.abc import Iterator
import os
from pathlib import Path
import re
import signal

from humanoid_common.testing.launching import running_launch_file
from humanoid_common.testing.processes import is_alive, RunningProgram
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_common.testing.waiting import wait_until
from humanoid_simulation.testing.simulators import RobotClient
import pytest

LAUNCH_FILE = Path(__file__).parents[1] / 'launch' / 'bringup.launch.py'
STARTED = re.compile(r'\[(\w+)-\d+\]: process started with pid \[(\d+)\]')
PATIENCE_S = 100.0


@pytest.fixture
def ros() -> Iterator[RosSandbox]:
    """Give a domain of its own."""
    with ros_sandbox() as sandbox:
        yield sandbox


@pytest.fixture
def bringup(ros: RosSandbox) -> Iterator[RunningProgram]:
    """Start everything, the viewer too."""
    with running_launch_file(LAUNCH_FILE, 'backend:=mujoco', 'gui:=true') as program:
        yield program


def processes(bringup: RunningProgram) -> dict[str, int]:
    """Return the number of each process by its executable."""
    return {name: int(pid) for name, pid in STARTED.findall(bringup.output)}


def test_it_stands_on_without_the_others(ros: RosSandbox, bringup: RunningProgram) -> None:
    """Neither what shows the robot nor what moves its arms keeps it on its feet."""
    robot = RobotClient(ros)
    robot.wait(1.0)
    for name in ('rviz2', 'robot_state_publisher', 'joint_controller'):
        pid = processes(bringup)[name]
        os.kill(pid, signal.SIGKILL)
        wait_until(lambda pid=pid: not is_alive(pid), PATIENCE_S, lambda: 'the end of a process')
        robot.wait(2.0)
    assert not bringup.has_ended


def test_without_the_simulator_all_ends(ros: RosSandbox, bringup: RunningProgram) -> None:
    """The launch says what is gone, and ends what is left."""
    RobotClient(ros)
    started = processes(bringup)
    os.kill(started['simulator'], signal.SIGKILL)
    report = bringup.wait_for_exit(PATIENCE_S)
    assert re.search(r'The robot is gone: simulator\S* was killed by signal 9', report.output)
    assert [name for name, pid in started.items() if is_alive(pid)] == []
