# SPDX-License-Identifier: Apache-2.0
"""Check how the executables start and end."""

from __future__ import annotations

import signal
import sys

from humanoid_common.testing.processes import assert_clean_exit, module_command, running_program
from humanoid_common.testing.ros import ros_sandbox
import pytest


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_signal(number: signal.Signals) -> None:
    """The simulator starts, says so, and ends in order."""
    command = module_command('humanoid_simulation.starting')
    with ros_sandbox(), running_program(command) as program:
        program.wait_for_output('Simulator started: one robot in the scene', timeout_s=60.0)
        assert_clean_exit(program.stop(number))


def test_a_scene_that_is_not_there() -> None:
    """The simulator says so in a sentence, with status 1."""
    command = module_command('humanoid_simulation.starting', '--ros-args', '-p', 'scene:=nowhere')
    with ros_sandbox(), running_program(command) as program:
        report = program.wait_for_exit()
    assert report.status == 1 and 'Traceback' not in report.stderr
    assert "The simulator cannot start. There is no scene 'nowhere'" in report.stderr


def test_what_takes_long_is_loaded_where_signals_are_heard() -> None:
    """Before that, Ctrl-C would end in a traceback."""
    code = 'import sys, humanoid_simulation.starting; sys.exit("mujoco" in sys.modules)'
    with running_program([sys.executable, '-c', code]) as program:
        assert program.wait_for_exit().status == 0


def test_a_drawing_library_that_is_set_but_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    """The node itself draws nothing, and starts whatever others have set."""
    monkeypatch.setenv('MUJOCO_GL', 'nonsense')
    command = module_command('humanoid_simulation.starting', '--ros-args', '-p', 'scene:=nowhere')
    with ros_sandbox(), running_program(command) as program:
        assert "There is no scene 'nowhere'" in program.wait_for_exit().stderr
