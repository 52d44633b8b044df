# SPDX-License-Identifier: Apache-2.0
"""Check how nodes start and end."""

from __future__ import annotations

from pathlib import Path
import signal
import sys
import time

from humanoid_common.testing.processes import (
    assert_clean_exit,
    ExitReport,
    running_program,
    RunningProgram,
)
from humanoid_common.testing.ros import ros_sandbox
from humanoid_common.testing.waiting import wait_until
import pytest

HEAD = """
import sys, time
from humanoid_common.errors import UserError
from humanoid_common.running import run_node
from rclpy.node import Node
"""
BUSY = (
    HEAD
    + """
class Busy(Node):
    def __init__(self):
        super().__init__('busy')
        self.create_timer(0.001, lambda: self.get_logger().debug('tick'))
        self.get_logger().info('ready')
sys.exit(run_node(Busy))
"""
)
STUCK = (
    HEAD
    + """
class Stuck(Node):
    def __init__(self):
        super().__init__('stuck')
        self.create_timer(0.001, self.block)
    def block(self):
        self.get_logger().info('ready')
        while True:
            time.sleep(0.01)
sys.exit(run_node(Stuck))
"""
)
REFUSING = (
    HEAD
    + """
def refuse():
    raise UserError('There is no robot. Build one.')
sys.exit(run_node(refuse))
"""
)
ENDING = (
    HEAD
    + """
from humanoid_common.running import ending
class Attached(Node):
    def __init__(self):
        super().__init__('attached')
        self.create_timer(0.01, ending(self, self.look))
    def look(self):
        raise UserError('The robot is silent. Look at its line.')
sys.exit(run_node(Attached))
"""
)
BROKEN = (
    HEAD
    + """
def fail():
    raise RuntimeError('a mistake in the code')
sys.exit(run_node(fail))
"""
)


SLOW = (
    HEAD
    + """
def load():
    print('loading', flush=True)
    try:
        time.sleep(60.0)
    except KeyboardInterrupt as error:
        raise ImportError('half of it') from error
sys.exit(run_node(load))
"""
)

UNSEEN = (
    HEAD
    + """
import signal
import threading

def take_signal():
    time.sleep(0.5)
    signal.pthread_kill(threading.get_ident(), signal.SIGTERM)

def load():
    threading.Thread(target=take_signal, daemon=True).start()
    time.sleep(60.0)
sys.exit(run_node(load))
"""
)


def run(tmp_path: Path, code: str, *arguments: str, **environment: str) -> ExitReport:
    """Run code until it ends by itself."""
    command = [sys.executable, str(tmp_path / 'node.py'), *arguments]
    script = tmp_path / 'node.py'
    script.write_text(code, encoding='utf-8')
    with ros_sandbox(), running_program(command, environment) as program:
        return program.wait_for_exit()


def repeat(program: RunningProgram) -> None:
    """Press Ctrl-C, and give the node a moment."""
    program.send(signal.SIGINT)
    time.sleep(0.3)


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_signal_ends_in_order(tmp_path: Path, number: signal.Signals) -> None:
    """A node with much to do ends with status 0 and no traceback."""
    script = tmp_path / 'busy.py'
    script.write_text(BUSY, encoding='utf-8')
    with ros_sandbox(), running_program([sys.executable, str(script)]) as program:
        program.wait_for_output('ready')
        assert_clean_exit(program.stop(number))


def test_time_that_nobody_tells(tmp_path: Path) -> None:
    """A node that takes the time from /clock says that nobody publishes it, and works on."""
    script = tmp_path / 'busy.py'
    script.write_text(BUSY, encoding='utf-8')
    command = [sys.executable, str(script), '--ros-args', '-p', 'use_sim_time:=true']
    with ros_sandbox(), running_program(command) as program:
        program.wait_for_output('use_sim_time is true, but there is no publisher on /clock: ')
        assert_clean_exit(program.stop(signal.SIGTERM))


def test_repeated_signals(tmp_path: Path) -> None:
    """Signals that come thick and fast do not disturb the end."""
    script = tmp_path / 'busy.py'
    script.write_text(BUSY, encoding='utf-8')
    with ros_sandbox(), running_program([sys.executable, str(script)]) as program:
        program.wait_for_output('ready')
        for number in (signal.SIGINT, signal.SIGINT, signal.SIGTERM):
            program.send(number)
        assert_clean_exit(program.wait_for_exit())


def test_stuck_callback(tmp_path: Path) -> None:
    """A node whose callback never returns ends with repeated Ctrl-C, and the log says where."""
    script = tmp_path / 'stuck.py'
    script.write_text(STUCK, encoding='utf-8')
    with ros_sandbox(), running_program([sys.executable, str(script)]) as program:
        program.wait_for_output('ready')
        wait_until(
            lambda: program.has_ended,
            pause=lambda: repeat(program),
            message=lambda: f'the end of the node; it wrote: {program.output}',
        )
        report = program.wait_for_exit()
        assert report.status == 0 and 'Traceback' not in report.stderr
        assert 'in block' in report.stderr


def test_refusal_is_one_sentence(tmp_path: Path) -> None:
    """A node that cannot start says why, without a traceback, with status 1."""
    assert run(tmp_path, REFUSING) == ExitReport(1, '', 'There is no robot. Build one.\n')


def test_callback_that_ends_its_node(tmp_path: Path) -> None:
    """A node that cannot go on says why, without a traceback, with status 1."""
    sentence = 'The robot is silent. Look at its line.\n'
    assert run(tmp_path, ENDING) == ExitReport(1, '', sentence)


def test_mistake_keeps_its_traceback(tmp_path: Path) -> None:
    """A mistake in the code is not hidden."""
    report = run(tmp_path, BROKEN)
    assert report.status == 1 and 'RuntimeError: a mistake in the code' in report.stderr


def test_bad_ros_arguments(tmp_path: Path) -> None:
    """ROS arguments that cannot be used are named, without a traceback."""
    report = run(tmp_path, BUSY, '--ros-args', '-p', 'no_value')
    assert report.status == 1 and 'Traceback' not in report.stderr
    assert 'no_value' in report.stderr and 'Correct what follows --ros-args' in report.stderr


def test_log_that_cannot_be_written(tmp_path: Path) -> None:
    """It is not the arguments that are at fault then."""
    in_a_file = tmp_path / 'file' / 'log'
    in_a_file.parent.touch()
    report = run(tmp_path, BUSY, ROS_LOG_DIR=str(in_a_file))
    assert report.status == 1 and 'Set ROS_LOG_DIR' in report.stderr
    assert '--ros-args' not in report.stderr


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_signal_while_it_starts(tmp_path: Path, number: signal.Signals) -> None:
    """A node that is still being made ends at once, and without a traceback."""
    script = tmp_path / 'node.py'
    script.write_text(SLOW, encoding='utf-8')
    with ros_sandbox(), running_program([sys.executable, str(script)]) as program:
        program.wait_for_output('loading')
        assert_clean_exit(program.stop(number))


def test_signal_that_the_main_thread_does_not_see(tmp_path: Path) -> None:
    """A signal to another thread does not interrupt what the main thread waits for."""
    assert run(tmp_path, UNSEEN) == ExitReport(0, '', '')
