# SPDX-License-Identifier: Apache-2.0
"""The programs as processes."""

from __future__ import annotations

from collections.abc import Callable
import os
from pathlib import Path
import signal
import subprocess
import threading

import pytest

Start = Callable[..., subprocess.Popen[str]]
TIMEOUT_S = 100.0
PUBLISHER = 'tf2_ros.static_transform_publisher'
OLDER_THREAD = """
import sys
import threading

threading.Thread(target=threading.Event().wait, daemon=True).start()
from tf2_ros.tf2_monitor import main

sys.exit(main())
"""
WITH_TASK = """
import sys
from tf2_ros.executing import sleep
from tf2_ros.program import run_node


def make(_):
    from rclpy.node import Node

    return Node('worker')


async def work(node):
    await sleep(node, 0.01)
    print('slept', flush=True)
    {then}


sys.exit(run_node(make, task=work))
"""
ARGUMENTS = ['--x', '1', '--yaw', '0.5', '--frame-id', 'map', '--child-frame-id', 'odom']


def read_until(stream: object, text: str) -> str:
    """Return what comes up to a text; fail when nothing comes for long."""
    lines: list[str] = []

    def read() -> None:
        for line in stream:  # type: ignore[attr-defined]
            lines.append(line)
            if text in line:
                break

    thread = threading.Thread(target=read, daemon=True)
    thread.start()
    thread.join(TIMEOUT_S)
    assert lines and text in lines[-1], ''.join(lines)
    return ''.join(lines)


def end(process: subprocess.Popen[str], number: signal.Signals) -> None:
    """Stop a program, which ends in order."""
    process.send_signal(number)
    _, errors = process.communicate(timeout=TIMEOUT_S)
    assert process.returncode == 0 and 'Traceback' not in errors


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_publisher_and_echo(start_program: Start, number: signal.Signals) -> None:
    """The publisher says what it publishes, and tf2_echo prints it; both end in order."""
    publisher = start_program(PUBLISHER, *ARGUMENTS)
    text = read_until(publisher.stderr, "from 'map' to 'odom'")
    assert 'Spinning until stopped - publishing transform' in text
    assert "translation: ('1.000000', '0.000000', '0.000000')" in text
    assert "rotation: ('0.000000', '0.000000', '0.247404', '0.968912')" in text
    echo = start_program('tf2_ros.tf2_echo', 'map', 'odom', '5', '-p', '2')
    text = read_until(echo.stdout, '- Translation')
    assert text.splitlines() == ['At time 0.0', '- Translation: [1.00, 0.00, 0.00]']
    end(echo, number)
    end(publisher, number)


def test_echo_waits(start_program: Start) -> None:
    """Without the transform tf2_echo says what it waits for."""
    echo = start_program('tf2_ros.tf2_echo', 'mars', 'venus')
    text = read_until(echo.stderr, 'Waiting for transform')
    assert (
        '[tf2_echo]: Waiting for transform mars ->  venus: Invalid frame ID "mars" passed to '
        'canTransform argument target_frame - frame does not exist' in text
    )
    end(echo, signal.SIGTERM)


def test_echo_without_a_clock(start_program: Start) -> None:
    """Whoever waits for simulated time that nobody publishes is told so."""
    echo = start_program('tf2_ros.tf2_echo', 'a', 'b', '--ros-args', '-p', 'use_sim_time:=true')
    read_until(echo.stderr, 'use_sim_time is true, but there is no publisher on /clock: ')
    end(echo, signal.SIGTERM)


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_monitor(start_program: Start, number: signal.Signals) -> None:
    """The monitor prints the frames between two."""
    start_program(PUBLISHER, *ARGUMENTS)
    monitor = start_program('tf2_ros.tf2_monitor', 'map', 'odom', '--period', '0.5')
    text = read_until(monitor.stdout, 'Frame: odom, published by')
    assert 'Gathering data on map -> odom for 0.5 seconds...' in text
    assert 'RESULTS: for map to odom\nChain is: map -> odom\n' in text
    end(monitor, number)


def test_bad_arguments(start_program: Start) -> None:
    """Mistakes are sentences, not tracebacks."""
    for module, words, text in (
        ('tf2_ros.tf2_echo', ['map'], 'required: target_frame'),
        (
            'tf2_ros.tf2_echo',
            ['map', 'odom', '-1'],
            'not a rate in Hz: give a number from 1e-06 to 1e+06',
        ),
        ('tf2_ros.tf2_echo', ['map', 'odom', 'fast'], "'fast' is not a rate in Hz"),
        ('tf2_ros.tf2_echo', ['map', 'odom', '1e-300'], "'1e-300' is not a rate in Hz"),
        ('tf2_ros.tf2_echo', ['map', 'odom', '-p', '16'], "'16' is not between 0 and 15 digits"),
        ('tf2_ros.tf2_monitor', ['--period', '0'], "'0' is not a period in seconds"),
        ('tf2_ros.tf2_monitor', ['--period', 'nan'], "'nan' is not a period in seconds"),
        ('tf2_ros.tf2_monitor', ['map'], 'give two frames'),
        (PUBLISHER, [*ARGUMENTS, '--ros-args', '-p', 'wrong'], 'The ROS arguments cannot be used'),
    ):
        process = start_program(module, *words)
        _, errors = process.communicate(timeout=TIMEOUT_S)
        assert process.returncode in (1, 2) and 'Traceback' not in errors
        assert text in errors


def test_no_place_for_the_log(
    start_program: Start, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where the log cannot be written, it is not the arguments that are to blame."""
    (tmp_path / 'file').touch()
    monkeypatch.setenv('ROS_LOG_DIR', str(tmp_path / 'file'))
    process = start_program('tf2_ros.tf2_echo', 'map', 'odom')
    _, errors = process.communicate(timeout=TIMEOUT_S)
    assert process.returncode == 1 and 'Traceback' not in errors
    assert 'The log cannot be written' in errors and 'Set ROS_LOG_DIR, or HOME' in errors


def test_full_disk(start_program: Start) -> None:
    """When the output finds no room, that is said, and the status is 1."""
    with open('/dev/full', 'w') as full:
        monitor = start_program('tf2_ros.tf2_monitor', stdout=full)
        _, errors = monitor.communicate(timeout=TIMEOUT_S)
    assert errors == 'The output cannot be written: No space left on device\n'
    assert monitor.returncode == 1


def test_impatience(start_program: Start, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Several signals do no more than one, also if there is a thread that does not block them."""
    (tmp_path / 'older_thread.py').write_text(OLDER_THREAD)
    monkeypatch.setenv('PYTHONPATH', str(tmp_path), prepend=os.pathsep)
    for numbers in ([signal.SIGINT] * 3, [signal.SIGTERM, signal.SIGINT] * 2):
        monitor = start_program('older_thread')
        read_until(monitor.stdout, 'Gathering data')
        for number in numbers:
            monitor.send_signal(number)
        _, errors = monitor.communicate(timeout=TIMEOUT_S)
        assert (monitor.returncode, errors) == (0, '')


@pytest.mark.parametrize(
    ('then', 'number', 'status', 'text'),
    [
        ('pass', None, 0, ''),
        ('await sleep(node, 1000.0)', signal.SIGINT, 0, ''),
        ("raise OverflowError('too much')", None, 1, 'OverflowError: too much'),
    ],
)
def test_task(
    start_program: Start,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    then: str,
    number: signal.Signals | None,
    status: int,
    text: str,
) -> None:
    """A program ends with its task, with a signal before that, or because the task has failed."""
    (tmp_path / 'with_task.py').write_text(WITH_TASK.format(then=then))
    monkeypatch.setenv('PYTHONPATH', str(tmp_path), prepend=os.pathsep)
    program = start_program('with_task')
    read_until(program.stdout, 'slept')
    if number is not None:
        program.send_signal(number)
    _, errors = program.communicate(timeout=TIMEOUT_S)
    assert program.returncode == status
    assert text in errors and ('Traceback' in errors) == bool(text)
