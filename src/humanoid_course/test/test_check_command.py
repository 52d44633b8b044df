# SPDX-License-Identifier: Apache-2.0
"""Check the command with real packages, which it builds and runs."""

from __future__ import annotations

from pathlib import Path
import signal

from humanoid_common.testing.processes import is_alive, module_command, running_program
from humanoid_common.testing.waiting import wait_until
from humanoid_course.grading import Outcome
from humanoid_course.testing import (
    criteria_in,
    Mistake,
    run_check,
    TEMPERATURE_MONITOR,
    THREE_ROBOTS,
    write_workspace,
)
import pytest

SOLUTIONS = Path(__file__).resolve().parents[2]
"""The source folder of this workspace, which has solutions of the exercises."""


def test_our_solution_passes() -> None:
    """The solution of exercise 3 in this workspace, two packages, passes every criterion."""
    status, output = run_check('exercise_3', '--workspace', str(SOLUTIONS))
    assert status == 0, output
    assert 'exercise_3: all 8 criteria are passed.' in output


def test_absolute_topic_name(tmp_path: Path) -> None:
    """A namespace that has no effect fails one criterion; nothing is written to the sources."""
    mistake = Mistake(
        'humanoid_control/humanoid_control/joint_controller.py',
        "'joint_commands'",
        "'/joint_commands'",
    )
    write_workspace(tmp_path, THREE_ROBOTS, mistake)
    before = sorted(tmp_path.rglob('*'))
    status, output = run_check('exercise_2', '--workspace', str(tmp_path))
    assert status == 1
    assert criteria_in(output, Outcome.FAILED) == ['topics'], output
    assert criteria_in(output, Outcome.UNCHECKED) == ['independence']
    assert "Write 'joint_commands' without the slash" in output
    assert sorted(tmp_path.rglob('*')) == before


def test_interrupt(tmp_path: Path) -> None:
    """Ctrl-C ends the command and the build that hangs, with a sentence."""
    pid_file = tmp_path / 'pid'
    script = f"import os, time\nopen('{pid_file}', 'w').write(f'{{os.getpid()}}.')\n"
    hangs = f'{script}time.sleep(600)\n'
    mistake = Mistake('temperature_monitor/setup.py', 'from glob', f'{hangs}from glob')
    write_workspace(tmp_path / 'ws', TEMPERATURE_MONITOR, mistake)
    command = module_command(
        'humanoid_course.check', 'exercise_1', '--workspace', str(tmp_path / 'ws')
    )
    with running_program(command) as program:
        wait_until(lambda: pid_file.exists() and pid_file.read_text().endswith('.'))
        report = program.stop(signal.SIGINT)
    assert report.status == 130
    assert report.stderr == '\nInterrupted: everything that was started has been ended.\n'
    assert not is_alive(int(pid_file.read_text()[:-1]))


@pytest.mark.parametrize(
    ('arguments', 'status', 'words'),
    [
        ((), 0, 'exercise_2: launch three controllers'),
        (('--list',), 0, 'Check your package with: ros2 run humanoid_course check EXERCISE'),
        (('exercise_4',), 2, "There is no exercise 'exercise_4'. Did you mean 'exercise_"),
        (('1', '--package', 'temp', '--workspace', str(SOLUTIONS)), 2, "no package 'temp' in"),
    ],
)
def test_without_a_check(arguments: tuple[str, ...], status: int, words: str) -> None:
    """The list, and what cannot be checked."""
    ended, output = run_check(*arguments)
    assert (ended, words in output) == (status, True), output


def test_nothing_is_sourced(monkeypatch: pytest.MonkeyPatch) -> None:
    """A terminal without ROS gets a sentence."""
    monkeypatch.delenv('AMENT_PREFIX_PATH')
    status, output = run_check('exercise_1', '--workspace', str(SOLUTIONS))
    assert status == 2 and output.startswith('ROS is not sourced in this terminal'), output
