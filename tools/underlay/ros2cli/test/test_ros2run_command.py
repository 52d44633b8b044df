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
from ros2cli.cli import main

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
    output, errors = process.communicate(timeout=100)
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
    output, errors = process.communicate(timeout=100)
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


def found(prefix: str, *names: str) -> str:
    """Return the lines that list several executables."""
    return ''.join(f'- {prefix}/lib/arm/{name}\n' for name in names)


@pytest.mark.parametrize(
    ('words', 'errors'),
    [
        (
            ['arm', 'fial'],
            "No executable found\nThe executables of 'arm': catcher, echo_all, fail, killed, "
            "no_interpreter, read_line, twice, twice. Did you mean 'fail'?\n",
        ),
        (['arm', 'twice'], 'Multiple executables found:\n{found}'),
        (
            ['arm', 'no_interpreter'],
            "cannot run '{prefix}/lib/arm/no_interpreter': No such file or directory. Its first "
            'line (#!) names an interpreter that does not exist.\n',
        ),
        (
            ['--prefix', 'no_such_program', 'arm', 'fail'],
            "cannot run 'no_such_program': No such file or directory\n",
        ),
    ],
)
def test_errors(words: list[str], errors: str, ros2: Ros2, arm: dict[str, str]) -> None:
    """What cannot be run is an error with the known text first."""
    prefix = arm['AMENT_PREFIX_PATH']
    result = ros2('run', *words, extra=arm)
    expected = errors.format(prefix=prefix, found=found(prefix, 'deep/twice', 'twice'))
    assert (result.stdout, result.stderr, result.returncode) == ('', expected, 1)


def test_unknown_package(ros2: Ros2, arm: dict[str, str]) -> None:
    """An unknown package is named, with where it was looked for below that."""
    result = ros2('run', 'nope', 'fail', extra=arm)
    assert (result.stdout, result.returncode) == ('', 1)
    assert result.stderr.startswith(
        "Package 'nope' not found\nIt is not in any folder of AMENT_PREFIX_PATH"
    )


@pytest.mark.parametrize(
    ('words', 'error'),
    [
        (
            [],
            'ros2 run: error: the following arguments are required: package_name, executable_name',
        ),
        (['arm'], 'ros2 run: error: the following arguments are required: executable_name'),
        (
            ['--prefix', "'", 'arm', 'fail'],
            'ros2 run: error: argument --prefix: "\'" is not a valid command: No closing '
            'quotation',
        ),
        (['--nope', 'arm', 'fail'], 'ros2: error: unrecognized arguments: --nope'),
    ],
)
def test_usage_errors(words: list[str], error: str, capsys: pytest.CaptureFixture[str]) -> None:
    """What the parser refuses has status 2 and the usage above the reason."""
    assert main(['run', *words]) == 2
    output, errors = capsys.readouterr()
    assert output == ''
    assert errors.startswith('usage: ros2')
    assert errors.splitlines()[-1].startswith(error)
