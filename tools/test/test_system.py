# SPDX-License-Identifier: Apache-2.0
"""Tests of the whole: real nodes, started by `ros2 launch`, that exchange messages over DDS."""

from __future__ import annotations

from collections.abc import Callable
import os
from pathlib import Path
import pty
import re
import signal
import subprocess

from programs import Program, wait_until
import pytest

Start = Callable[..., Program]
REPORT = re.compile(r'left_shoulder: -?\d\.\d{3} rad')


@pytest.fixture
def ros2(root: Path, start: Start, own_domain: int) -> Start:
    """Return a function that starts a `ros2` command."""
    return lambda *arguments: start(str(root / 'tools' / 'ros2'), *arguments)


def wait_for_reports(program: Program) -> None:
    """Wait until the listener has heard the controller."""
    wait_until(
        lambda: REPORT.search(program.output) or program.has_ended, 100.0, lambda: program.output
    )
    assert REPORT.search(program.output), program.output


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_ends_the_robot_in_order(ros2: Start, number: int) -> None:
    """The main job runs, and ends with status 0 and nothing left; no process had to be killed."""
    program = ros2('launch', 'humanoid_bringup', 'bringup.launch.py')
    wait_for_reports(program)
    program.wait_for('RViz is at')
    assert program.end(number) == 0
    assert 'failed to terminate' not in program.output
    assert 'Traceback' not in program.output
    assert 'process has died' not in program.output
    assert program.members() == []


def test_the_sudden_death_of_the_launcher_leaves_nothing(ros2: Start) -> None:
    """After kill -9 of the launcher its nodes end as well."""
    program = ros2('launch', 'humanoid_bringup', 'bringup.launch.py')
    wait_for_reports(program)
    assert program.end(signal.SIGKILL) == -signal.SIGKILL
    wait_until(lambda: program.members() == [], 15.0, lambda: f'{program.members()} to end')


def test_make_bringup_on_a_terminal_ends_with_status_0(root: Path, own_domain: int) -> None:
    """Ctrl-C on the terminal in which `make bringup` runs: make itself ends with status 0."""
    pid, terminal = pty.fork()
    if pid == 0:
        os.chdir(root)
        os.execvp('make', ['make', 'bringup'])
    output = b''
    try:
        while not REPORT.search(output.decode(errors='replace')):
            output += os.read(terminal, 4096)
        os.write(terminal, b'\x03')
        while chunk := read(terminal):
            output += chunk
        _, status = os.waitpid(pid, 0)
    finally:
        os.close(terminal)
    assert os.waitstatus_to_exitcode(status) == 0, output.decode()
    assert b'Traceback' not in output


def read(terminal: int) -> bytes:
    """Read what a terminal shows; empty when its programs have ended."""
    try:
        return os.read(terminal, 4096)
    except OSError:
        return b''


def test_without_the_controller_nothing_is_commanded(ros2: Start) -> None:
    """The condition on use_controller leaves the listener alone."""
    program = ros2('launch', 'humanoid_bringup', 'bringup.launch.py', 'use_controller:=false')
    program.wait_for('Sensor Processor started')
    assert 'joint_controller' not in program.output
    assert program.end() == 0


def test_three_robots_publish_each_on_its_own(ros2: Start) -> None:
    """Three namespaces, three topics, and messages on each."""
    program = ros2('launch', 'humanoid_bringup', 'multi_robot.launch.py')
    wait_until(lambda: program.output.count('started (50 Hz)') == 3, 30.0, lambda: program.output)
    listing = ros2('topic', 'list')
    listing.process.wait(timeout=100)
    topics = [f'/robot{number}/joint_commands' for number in (1, 2, 3)]
    assert [line for line in listing.output.splitlines() if 'joint_commands' in line] == topics
    for topic in topics:
        echo = ros2('topic', 'echo', '--once', topic)
        echo.wait_for('- left_shoulder')
        assert echo.process.wait(timeout=100) == 0
    assert program.end() == 0
    assert program.members() == []


def test_the_controller_keeps_its_rate(ros2: Start) -> None:
    """`ros2 topic hz` shows fifty messages a second, on the average of some seconds.

    The machine may be busy with something else at first, but not all the time.
    """
    program = ros2('run', 'humanoid_control', 'joint_controller')
    rate = ros2('topic', 'hz', '/joint_commands')

    def is_right() -> bool:
        found = re.findall(r'average rate: ([\d.]+)', rate.output)
        return len(found) > 3 and abs(float(found[-1]) - 50.0) <= 1.0

    wait_until(is_right, 60.0, lambda: rate.output)
    assert rate.end() == 2
    assert program.end() == 0


def test_a_temperature_is_echoed(root: Path, ros2: Start) -> None:
    """The smallest package, seen with the command line."""
    publisher = ros2('run', 'temperature_monitor', 'temp_publisher')
    publisher.wait_for('Publishing the temperature')
    echo = ros2('topic', 'echo', '/temperature', '--once', '--field', 'temperature')
    assert echo.process.wait(timeout=100) == 0
    assert 20.0 <= float(echo.output.splitlines()[-2]) <= 30.0
    assert publisher.end() == 0


def test_arguments_are_listed(root: Path) -> None:
    """`--show-args` names the arguments that the main launch file forwards."""
    command = [root / 'tools' / 'ros2', 'launch', 'humanoid_bringup', 'bringup.launch.py', '-s']
    output = subprocess.check_output(command, encoding='utf-8')
    assert "    'use_controller':\n" in output
    assert "    'use_sim_time':\n" in output
