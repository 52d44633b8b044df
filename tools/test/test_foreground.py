# SPDX-License-Identifier: Apache-2.0
"""Tests of running a command as a job of its own."""

from __future__ import annotations

from collections.abc import Callable
import os
from pathlib import Path
import pty
import signal
import subprocess
from typing import Any

import pytest

JOB = """
trap 'echo got INT; exit 7' INT
trap 'echo got TERM; exit 8' TERM
echo ready
while :; do sleep 0.05; done
"""


def test_the_status_passes_through(root: Path) -> None:
    """The job's exit status is the command's; a signal counts as in a shell."""
    foreground = str(root / 'tools' / 'foreground')
    assert subprocess.call([foreground, 'sh', '-c', 'exit 5']) == 5
    assert subprocess.call([foreground, 'sh', '-c', 'kill -9 $$']) == 137


@pytest.mark.parametrize('command', [[], ['no-such-program']])
def test_a_command_that_is_not_there_is_named(root: Path, command: list[str]) -> None:
    """A missing command gets a sentence, as in a shell with status 127."""
    done = subprocess.run(
        [root / 'tools' / 'foreground', *command],
        capture_output=True,
        encoding='utf-8',
        check=False,
    )
    assert done.returncode == 127
    assert done.stderr.endswith('tools/foreground COMMAND...\n')
    assert 'Traceback' not in done.stderr


@pytest.mark.parametrize(('number', 'status'), [(signal.SIGINT, 7), (signal.SIGTERM, 8)])
def test_signals_are_passed_on(
    root: Path, start: Callable[..., Any], number: int, status: int
) -> None:
    """A signal to the runner reaches the job, whose status is returned."""
    program = start(str(root / 'tools' / 'foreground'), 'sh', '-c', JOB)
    program.wait_for('ready')
    assert program.end(number) == status
    assert program.members() == []


def test_ctrl_c_reaches_the_job_alone(root: Path) -> None:
    """On a terminal, the keys go to the job, and make ends with its status."""
    pid, terminal = pty.fork()
    if pid == 0:
        script = f'trap "exit 99" INT; "{root}/tools/foreground" sh -c "$0"; exit $?'
        os.execvp('sh', ['sh', '-c', script, JOB])
    try:
        output = b''
        while b'ready' not in output:
            output += os.read(terminal, 1000)
        os.write(terminal, b'\x03')
        _, status = os.waitpid(pid, 0)
    finally:
        os.close(terminal)
    assert os.waitstatus_to_exitcode(status) == 7
