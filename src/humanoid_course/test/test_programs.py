# SPDX-License-Identifier: Apache-2.0
"""Check that a student's program is ended even if it resists, and that its output is bounded."""

from __future__ import annotations

import os
from pathlib import Path
import signal
import sys
import time

from humanoid_common.testing.processes import is_alive
from humanoid_common.testing.waiting import wait_until
from humanoid_course.programs import Program, running
import pytest

STUBBORN = (
    'import os, signal, time\n'
    'signal.signal(signal.SIGINT, signal.SIG_IGN)\n'
    'if os.fork() == 0:\n'
    '    os.setsid()\n'
    'print(os.getpid(), flush=True)\n'
    'time.sleep(600)\n'
)


def python(script: str) -> list[str]:
    """Return the command that runs a script without site packages."""
    return [sys.executable, '-I', '-S', '-c', script]


def pids_of(program: Program) -> list[int]:
    """Wait for the two processes of the stubborn program."""
    wait_until(lambda: len(program.output.split()) == 2)
    return [int(word) for word in program.output.split()]


def test_what_ignores_the_interrupt_is_killed(tmp_path: Path) -> None:
    """That includes a child in a session of its own, and is reported."""
    with running(python(STUBBORN), os.environ, tmp_path) as program:
        pids = pids_of(program)
        left = program.interrupt(0.1)
    assert len(left) == 2 and all('python' in command for command in left)
    assert not any(map(is_alive, pids))


@pytest.mark.parametrize('kind', [KeyboardInterrupt, ValueError])
def test_an_exception_ends_the_program(kind: type[BaseException], tmp_path: Path) -> None:
    """Ctrl-C during a check leaves nothing behind."""
    pids: list[int] = []
    with pytest.raises(kind):
        with running(python(STUBBORN), os.environ, tmp_path) as program:
            pids += pids_of(program)
            raise kind
    assert pids and not any(map(is_alive, pids))


def test_ctrl_c_during_the_end(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """A second Ctrl-C waits until everything is ended, whichever thread receives it."""
    close = Program.close

    def interrupted_close(program: Program) -> None:
        os.kill(os.getpid(), signal.SIGINT)
        time.sleep(0.1)
        close(program)

    monkeypatch.setattr(Program, 'close', interrupted_close)
    pids: list[int] = []
    with pytest.raises(KeyboardInterrupt):
        with running(python(STUBBORN), os.environ, tmp_path) as program:
            pids += pids_of(program)
    assert pids and not any(map(is_alive, pids))
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_much_output(tmp_path: Path) -> None:
    """Of megabytes, the beginning and the end are kept."""
    script = 'print("first"); print("x" * 3_000_000); print("last")'
    with running(python(script), os.environ, tmp_path) as program:
        assert program.wait(60.0) and program.status == 0
        output = program.output
    assert output.startswith('first') and output.endswith('last\n') and len(output) < 100_000
    assert 'bytes left out' in output


def test_what_a_flood_ends_with(tmp_path: Path) -> None:
    """After megabytes, new output is still told from what was before it, in whole lines."""
    flood = 'for n in range(100_000): print("flood of numbers", n)\n'
    wait = 'try:\n print("before", flush=True)\n time.sleep(600)\n'
    script = f'import time\n{flood}{wait}except KeyboardInterrupt:\n print("bye", flush=True)\n'
    with running(python(script), os.environ, tmp_path) as program:
        start = program.mark()
        wait_until(lambda: program.output.endswith('before\n'))
        assert all(line[:5] in ('flood', 'befor') for line in program.since(0).splitlines())
        middle = program.mark()
        assert program.since(middle) == '' and middle > 1_000_000 > start
        assert program.interrupt(60.0) == ()
        assert program.since(middle) == 'bye\n'


def test_no_file_becomes_too_large(tmp_path: Path) -> None:
    """What a program writes into a file does not fill the disk."""
    script = 'import time; time.sleep(1.0); open("large", "wb").truncate(200_000_000)'
    with running(python(script), os.environ, tmp_path) as program:
        assert program.wait(60.0) and program.status == 1
        assert 'File too large' in program.output
    assert (tmp_path / 'large').stat().st_size == 0


def test_clean_end(tmp_path: Path) -> None:
    """A program that heeds the interrupt leaves nothing."""
    script = 'import time; print("up", flush=True); time.sleep(600)'
    with running(python(script), os.environ, tmp_path) as program:
        wait_until(lambda: 'up' in program.output)
        assert program.interrupt(60.0) == ()
        assert 'KeyboardInterrupt' in program.output
