# SPDX-License-Identifier: Apache-2.0
"""The end of a launch: nothing may outlive it."""

from __future__ import annotations

from collections.abc import Callable
import os
from pathlib import Path
import re
import signal
import subprocess
from typing import Any

from launch._supervision.process_group import living_members
import pytest

Start = Callable[[str], Any]
Wait = Callable[..., None]

READY = "ExecuteProcess(cmd=['sh', '-c', 'echo ready; {script}'], output='screen', {kwargs})"


def _process(script: str, kwargs: str = '') -> str:
    return READY.format(script=script.replace("'", "\\'"), kwargs=kwargs)


def _group(text: str) -> int:
    """Return the process id, and so the group, of the first process that was started."""
    found = re.search(r'process started with pid \[(\d+)\]', text)
    assert found is not None, text
    return int(found.group(1))


@pytest.mark.parametrize(
    'number, text',
    [
        (signal.SIGINT, 'user interrupted with ctrl-c (SIGINT)'),
        (signal.SIGTERM, 'asked to end by a signal (SIGTERM)'),
        (signal.SIGHUP, 'asked to end by a signal (SIGHUP)'),
    ],
)
def test_signals(launcher: Start, number: signal.Signals, text: str) -> None:
    """A signal ends the launch and its processes at once, with status 0."""
    launch = launcher(_process('exec sleep 60'))
    launch.wait_for('] ready')
    launch.process.send_signal(number)
    assert launch.end() == 0
    assert f'[WARNING] [launch]: {text}' in launch.text
    assert 'exit code -2' in launch.text and 'Traceback' not in launch.text
    assert living_members(_group(launch.text)) == []


def test_second_interrupt_is_ignored(launcher: Start, tmp_path: Path) -> None:
    """Who interrupts twice is told that the launch is ending."""
    file = tmp_path / 'seen'
    script = f'trap "" INT; until [ -e "{file}" ]; do sleep 0.05; done'
    launch = launcher(_process(script, 'sigterm_timeout=100'))
    launch.wait_for('] ready')
    launch.process.send_signal(signal.SIGINT)
    launch.wait_for('sending signal')
    launch.process.send_signal(signal.SIGINT)
    launch.wait_for('ctrl-c (SIGINT) again, ignoring...')
    file.touch()
    assert launch.end() == 0


def test_escalation(launcher: Start) -> None:
    """A process that ignores signals is killed when both timeouts are over."""
    launch = launcher(
        _process(
            'trap "" INT TERM; while :; do sleep 0.1; done',
            "sigterm_timeout='0.3', sigkill_timeout='0.2'",
        )
    )
    launch.wait_for('] ready')
    launch.process.send_signal(signal.SIGINT)
    assert launch.end() == 0
    text = launch.text
    assert (
        "failed to terminate '0.3' seconds after receiving 'SIGINT', escalating to 'SIGTERM'"
        in text
    )
    assert (
        "failed to terminate '0.5' seconds after receiving 'SIGTERM', escalating to 'SIGKILL'"
        in text
    )
    assert 'exit code -9' in text and living_members(_group(text)) == []


def test_whole_group_is_interrupted(launcher: Start) -> None:
    """What a process has started ends with it."""
    launch = launcher(_process('sleep 60 & sleep 61 & sleep 62; :'))
    launch.wait_for('] ready')
    launch.process.send_signal(signal.SIGTERM)
    assert launch.end() == 0
    assert living_members(_group(launch.text)) == []


def test_leftovers_of_a_process(launcher: Start) -> None:
    """What a process leaves behind at its end is ended, even if it ignores signals."""
    launch = launcher(_process('trap "" INT TERM; sleep 60 & exit 0'))
    assert launch.end() == 0
    assert 'finished cleanly' in launch.text
    assert living_members(_group(launch.text)) == []


def test_killed_launch(launcher: Start, wait_until: Wait) -> None:
    """Even if the launch is killed, its processes end."""
    launch = launcher(_process('exec sleep 60') + ', ' + _process('trap "" INT TERM; sleep 60'))
    launch.wait_for('] ready')
    wait_until(lambda: launch.text.count('] ready') == 2)
    groups = [int(pid) for pid in re.findall(r'started with pid \[(\d+)\]', launch.text)]
    launch.process.kill()
    launch.process.wait()
    wait_until(lambda: not any(living_members(group) for group in groups))


def test_output_to_a_full_disk(
    launch_command: list[str], write: Callable[[str, str], str]
) -> None:
    """The processes do their work although nobody can see it, but it is said that nobody can."""
    path = write(
        'it.launch.py',
        'from launch import LaunchDescription\nfrom launch.actions import *\n'
        'def generate_launch_description():\n    return LaunchDescription([\n'
        "        ExecuteProcess(cmd=['sh', '-c', 'echo x; echo y >&2'], output='screen')])\n",
    )
    with open('/dev/full', 'wb') as full:
        result = subprocess.run(
            [*launch_command, path], stdout=full, stderr=subprocess.PIPE, text=True, timeout=100
        )
    assert result.returncode == 0
    assert result.stderr == 'The output can no longer be written: No space left on device\n'


def test_closed_output(
    tmp_path: Path,
    write: Callable[[str, str], str],
    launch_command: list[str],
) -> None:
    """A launch whose output nobody reads any more ends quietly."""
    path = write(
        'it.launch.py',
        (
            'from launch import LaunchDescription\nfrom launch.actions import *\n'
            'def generate_launch_description():\n    return LaunchDescription([ExecuteProcess('
            "cmd=['sh', '-c', 'while :; do echo x; sleep 0.05; done'], output='screen')])\n"
        ),
    )
    with open(tmp_path / 'errors', 'wb') as errors:
        process = subprocess.Popen([*launch_command, path], stdout=subprocess.PIPE, stderr=errors)
    assert process.stdout is not None
    process.stdout.readline()
    process.stdout.close()
    try:
        assert process.wait(100) == 0
    finally:
        process.kill()
    assert (tmp_path / 'errors').read_text() == ''


def test_sigint_that_was_ignored_reaches_the_processes(
    tmp_path: Path,
    write: Callable[[str, str], str],
    launch_command: list[str],
    wait_until: Wait,
) -> None:
    """A launch that a script has put into the background can be interrupted all the same."""
    path = write(
        'it.launch.py',
        (
            'from launch import LaunchDescription\nfrom launch.actions import *\n'
            'def generate_launch_description():\n    return LaunchDescription(['
            f'{_process("exec sleep 60")}])\n'
        ),
    )
    output = tmp_path / 'output'
    with open(output, 'wb') as file:
        process = subprocess.Popen(
            ['sh', '-c', 'trap "" INT; exec "$@"', 'sh', *launch_command, path],
            stdout=file,
            stderr=subprocess.STDOUT,
        )
    try:
        wait_until(lambda: '] ready' in output.read_text())
        process.send_signal(signal.SIGINT)
        assert process.wait(100) == 0
    finally:
        process.kill()
        process.wait()
    assert 'exit code -2' in output.read_text()


@pytest.mark.usefixtures('no_child_is_left')
def test_no_child_is_left(run: Callable[..., Any]) -> None:
    """When a run is over, this process has no child, not even a dead one."""
    from launch.actions import ExecuteProcess, Shutdown

    run(ExecuteProcess(cmd=['true'], on_exit=Shutdown()), ExecuteProcess(cmd=['sleep', '60']))


def test_no_descriptor_is_left(run: Callable[..., Any]) -> None:
    """A run closes all that it has opened."""
    from launch.actions import ExecuteProcess

    run(ExecuteProcess(cmd=['true'], emulate_tty=True))
    before = len(os.listdir('/proc/self/fd'))
    run(ExecuteProcess(cmd=['true'], emulate_tty=True), ExecuteProcess(cmd=['true']))
    assert len(os.listdir('/proc/self/fd')) == before
