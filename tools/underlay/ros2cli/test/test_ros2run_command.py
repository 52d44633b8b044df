# SPDX-License-Identifier: Apache-2.0
"""Tests of `ros2 run` with real children."""

from collections.abc import Callable
import os
from pathlib import Path
import pty
import signal
import subprocess
from subprocess import CompletedProcess
import sys
from typing import Any

import pytest

Ros2 = Callable[..., CompletedProcess[str]]

CATCHER = """\
#!/usr/bin/env python3
import signal, sys
def stop(number, frame):
    print('got', signal.Signals(number).name, flush=True)
    sys.exit(7)
for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
    signal.signal(number, stop)
print('ready', flush=True)
while True:
    signal.pause()
"""
SCRIPTS = {
    'catcher': CATCHER,
    'fail': '#!/bin/sh\nexit 3\n',
    'killed': '#!/bin/sh\nkill -KILL $$\n',
    'echo_all': '#!/bin/sh\nfor word in "$@"; do echo "<$word>"; done\n',
    'read_line': '#!/bin/sh\nread line; echo "read $line"\n',
    'no_interpreter': '#!/no/such/interpreter\n',
    'deep/twice': '#!/bin/sh\n',
    'twice': '#!/bin/sh\n',
}


@pytest.fixture
def arm(tmp_path: Path) -> dict[str, str]:
    """Install a package with scripts in a prefix whose name has a space."""
    prefix = tmp_path / 'my prefix'
    index = prefix / 'share' / 'ament_index' / 'resource_index' / 'packages'
    index.mkdir(parents=True)
    (index / 'arm').touch()
    for name, text in SCRIPTS.items():
        path = prefix / 'lib' / 'arm' / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        path.chmod(0o755)
    return {'AMENT_PREFIX_PATH': str(prefix), 'COLCON_PREFIX_PATH': ''}


def test_arguments_are_passed_through(ros2: Ros2, arm: dict[str, str]) -> None:
    """All words after the executable reach it, options too."""
    words = ['--ros-args', '-r', 'a:=b', '--help', '', 'x y']
    result = ros2('run', 'arm', 'echo_all', *words, extra=arm)
    assert result.stdout == ''.join(f'<{word}>\n' for word in words)
    assert (result.returncode, result.stderr) == (0, '')


def test_prefix_stands_before_the_executable(ros2: Ros2, arm: dict[str, str]) -> None:
    """A prefix is split like a shell does it."""
    result = ros2('run', '--prefix', "echo 'two words'", 'arm', 'fail', extra=arm)
    assert result.stdout == f'two words {arm["AMENT_PREFIX_PATH"]}/lib/arm/fail\n'


@pytest.mark.parametrize(
    ('name', 'status', 'text'),
    [
        ('fail', 3, '[ros2run]: Process exited with failure 3\n'),
        ('killed', 247, '[ros2run]: Killed\n'),
    ],
)
def test_status_passes_through(
    name: str,
    status: int,
    text: str,
    start_ros2: Callable[..., Any],
    arm: dict[str, str],
) -> None:
    """The status of the child becomes ours, and is explained."""
    process = start_ros2('run', 'arm', name, extra=arm)
    output, errors = process.communicate(timeout=20.0)
    assert (process.returncode % 256, output, errors) == (status, text, '')


@pytest.mark.parametrize('sent', [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_signal_reaches_child(
    sent: signal.Signals,
    start_ros2: Callable[..., Any],
    arm: dict[str, str],
) -> None:
    """A signal to the command alone is passed on once, and the child's status is returned."""
    process = start_ros2('run', 'arm', 'catcher', extra=arm)
    assert process.stdout.readline() == 'ready\n'
    process.send_signal(sent)
    output, errors = process.communicate(timeout=20.0)
    assert output == f'got {sent.name}\n[ros2run]: Process exited with failure 7\n'
    assert (process.returncode, errors) == (7, '')


def test_ctrl_c_in_terminal_is_delivered_once(
    arm: dict[str, str],
    ros_environment_variables: dict[str, str],
) -> None:
    """In a terminal, which signals the child itself, nothing is passed on."""
    pid, terminal = pty.fork()
    if pid == 0:
        os.execve(
            sys.executable,
            [sys.executable, '-m', 'ros2cli', 'run', 'arm', 'catcher'],
            {**ros_environment_variables, **arm},
        )
    with os.fdopen(terminal, 'rb', buffering=0) as stream:
        output = read_until(stream, b'ready')
        os.write(terminal, b'\x03')
        output += read_until(stream, b'failure 7')
        status = os.waitpid(pid, 0)[1]
    assert os.waitstatus_to_exitcode(status) == 7
    assert output.count(b'got SIGINT') == 1


def read_until(stream: Any, text: bytes) -> bytes:
    """Return what a terminal shows until a text appears in it."""
    output = b''
    while text not in output:
        part = stream.read(1024)
        assert part, output
        output += part
    return output


def test_child_reads_stdin(arm: dict[str, str], ros_environment_variables: Any) -> None:
    """The child has the command's own standard input."""
    result = subprocess.run(
        [sys.executable, '-m', 'ros2cli', 'run', 'arm', 'read_line'],
        input='hello\n',
        env={**ros_environment_variables, **arm},
        capture_output=True,
        text=True,
        check=True,
    )
    assert result.stdout == 'read hello\n'


@pytest.mark.parametrize(
    ('words', 'texts'),
    [
        (['nope', 'fail'], ["Package 'nope' not found"]),
        (['arm', 'fial'], ['No executable found', "Did you mean 'fail'?"]),
        (['arm', 'twice'], ['Multiple executables found:', '/lib/arm/deep/twice']),
        (['arm', 'no_interpreter'], ['cannot run', 'names an interpreter that does not exist']),
    ],
)
def test_errors(words: list[str], texts: list[str], ros2: Ros2, arm: dict[str, str]) -> None:
    """What cannot be run is an error with the known text first."""
    result = ros2('run', *words, extra=arm)
    assert (result.returncode, result.stdout) == (1, '')
    assert result.stderr.startswith(texts[0])
    assert all(text in result.stderr for text in texts)
