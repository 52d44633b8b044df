# SPDX-License-Identifier: Apache-2.0
"""Check how tests run programs."""

from __future__ import annotations

import os
import signal
import sys

from humanoid_common.testing.processes import (
    assert_clean_exit,
    ExitReport,
    is_alive,
    running_program,
)
from humanoid_common.testing.waiting import wait_until, WaitedInVainError
import pytest

PARENT = """
import subprocess, sys
child = subprocess.Popen([sys.executable, '-c', 'import time; time.sleep(100)'])
print('child', child.pid, flush=True)
child.wait()
"""


def test_output_and_status() -> None:
    """Both streams and the exit status are reported."""
    code = 'import sys; print("out"); sys.stderr.write("err"); sys.exit(3)'
    with running_program([sys.executable, '-c', code]) as program:
        assert program.wait_for_exit() == ExitReport(3, 'out\n', 'err')


def test_nothing_is_left_behind() -> None:
    """Also the children of the program end, even when the test fails."""
    with pytest.raises(ZeroDivisionError), running_program([sys.executable, '-c', PARENT]) as it:
        it.wait_for_output('child ')
        pid = int(it.output.split()[1])
        assert is_alive(pid)
        _ = 1 / 0
    wait_until(lambda: not is_alive(pid), 5.0, lambda: 'the end of the child')


def test_early_end_is_told() -> None:
    """Waiting for output ends with the program, and shows what it wrote instead."""
    with running_program([sys.executable, '-c', 'print("hello")']) as program:
        with pytest.raises(WaitedInVainError, match="'bye'.*hello"):
            program.wait_for_output('bye')


def test_signal_reaches_the_program() -> None:
    """The signal ends the program, and the status tells so."""
    with running_program(['sleep', '100']) as program:
        assert program.stop(signal.SIGTERM).status == -signal.SIGTERM


def test_environment_is_added() -> None:
    """Variables are added to the present environment."""
    code = 'import os; print(os.environ["HUMANOID_TEST"], os.environ["PATH"])'
    with running_program([sys.executable, '-c', code], {'HUMANOID_TEST': 'x'}) as program:
        assert program.wait_for_exit().stdout == f'x {os.environ["PATH"]}\n'


@pytest.mark.parametrize(
    'report', [ExitReport(1, '', ''), ExitReport(0, '', 'Traceback (most recent call last):\n')]
)
def test_unclean_exit(report: ExitReport) -> None:
    """A status other than 0, or more than log lines on stderr, is not a clean exit."""
    with pytest.raises(AssertionError):
        assert_clean_exit(report)
