# SPDX-License-Identifier: Apache-2.0
"""Check the command with real runs of a few simulated seconds, and their replay."""

from __future__ import annotations

from collections.abc import Iterator
import os
from pathlib import Path
import shutil
import signal

from humanoid_common.testing.processes import assert_clean_exit, module_command, running_program
from humanoid_common.testing.ros import ros_sandbox
from humanoid_simulation.sweep import command
from humanoid_simulation.sweep.conditions import conditions_of, Run
from humanoid_simulation.sweep.record import NAME, read_record
from humanoid_simulation.sweep.results import FinishedRun
from humanoid_simulation.sweep.walk import walk
import pytest

EXPERIMENT = """
falls_allowed: 0.4
conditions:
  seconds: 3.0
  forward_m_s: 0.2
  push_at_s: 1.5
  push_ns: [0.0, 120.0]
"""


@pytest.fixture(name='folder', scope='module')
def _folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder in which an experiment has been done."""
    folder = tmp_path_factory.mktemp('sweep')
    (folder / 'push.yaml').write_text(EXPERIMENT)
    assert sweep(folder, '--processes', '2') == command.FALLS_EXIT
    return folder


def sweep(folder: Path, *arguments: str) -> int:
    """Do the experiment."""
    return command.main([str(folder / 'push.yaml'), '--output', str(folder / 'out'), *arguments])


def runs(folder: Path) -> list[FinishedRun]:
    """Return the finished runs, without a push and with one."""
    finished = read_record(folder / 'out' / NAME)[0].values()
    return sorted(finished, key=lambda run: run.conditions['push_ns'])


def test_results(folder: Path) -> None:
    """The hard push makes it fall, at a time after it; without it, it walks."""
    walked, pushed = (run.result for run in runs(folder))
    assert walked.outcome == 'stood' and walked.survived_s == pytest.approx(3.0, abs=0.02)
    assert walked.distance_m > 0.1 and walked.largest_tilt_rad < 0.2 and walked.push_s == 0.0
    assert pushed.outcome == 'fell' and pushed.push_s == pytest.approx(1.5, abs=0.02)
    assert pushed.push_s < pushed.survived_s < 3.0 and pushed.push_x_ns > 100.0
    assert walked.phase == pushed.phase == 'walk'


def test_a_run_is_repeatable(folder: Path) -> None:
    """In another process, bit for bit; a replay shows what has happened."""
    pushed = runs(folder)[1]
    again = walk(Run(conditions_of(dict(pushed.conditions)), pushed.key))
    assert {**vars(again), 'cpu_s': 0.0} == {**vars(pushed.result), 'cpu_s': 0.0}


def test_files(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Report and table are there; the same command again does nothing but write them."""
    before = (folder / 'out' / NAME).read_bytes()
    (folder / 'out' / 'report.html').unlink()
    assert sweep(folder) == command.FALLS_EXIT
    assert (folder / 'out' / NAME).read_bytes() == before
    page = (folder / 'out' / 'report.html').read_text()
    assert f'--output {folder}/out --replay KEY' in page and '2 of 2' in page
    output = capsys.readouterr().out
    assert '2 of 2 runs are finished already, 0 are left' in output
    assert '1 of 2 stood, 1 fell' in output


def test_plan(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It says what is left, and does nothing."""
    assert sweep(folder, '--plan', '--set', 'seeds=2') == 0
    assert capsys.readouterr().out == (
        'push: 4 runs, 12 s of walking; 2 are finished, 2 are left. Varied: push_ns.\n'
    )


@pytest.mark.parametrize(
    ('arguments', 'sentence'),
    [
        (['--set', 'frictoin=1'], "Did you mean 'friction'?"),
        (['--replay', 'xyz'], "has a key that begins with 'xyz'"),
        (['--replay', ''], "has a key that begins with ''"),
    ],
)
def test_mistakes(
    folder: Path, arguments: list[str], sentence: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """They are said in a sentence, with status 2."""
    assert sweep(folder, *arguments) == command.PROBLEM_EXIT
    assert sentence in capsys.readouterr().err


def test_no_such_experiment(capsys: pytest.CaptureFixture[str]) -> None:
    """The installed ones are named."""
    assert command.main(['saok']) == command.PROBLEM_EXIT
    assert "There is no experiment 'saok'. Did you mean 'soak'?" in capsys.readouterr().err


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_an_interrupted_sweep_keeps_its_runs(tmp_path: Path, number: signal.Signals) -> None:
    """It ends at once with its workers and no traceback, and has written a report."""
    (tmp_path / 'long.yaml').write_text('conditions: {seconds: [3000.0]}')
    words = [str(tmp_path / 'long.yaml'), '--output', str(tmp_path / 'out'), '--processes', '1']
    with running_program(module_command('humanoid_simulation.sweep.command', *words)) as program:
        program.wait_for_output('0 of 1 runs are finished already')
        report = program.stop(number)
    assert report.status == 128 + number and 'Traceback' not in report.output
    assert 'the same command does the others' in report.stderr
    assert '0 of 1' in (tmp_path / 'out' / 'report.html').read_text()


def test_a_cluster_without_ray(
    folder: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """It is said in a sentence, and nothing is left; what was finished before stays."""
    (tmp_path / 'ray.py').write_text("raise ImportError('get it with a command')")
    monkeypatch.syspath_prepend(tmp_path)  # the process of the engine has the same path
    (tmp_path / 'push.yaml').write_text(EXPERIMENT)
    assert sweep(tmp_path, '--ray', 'auto') == command.PROBLEM_EXIT
    assert 'needs the Python package ray (get it with a command)' in capsys.readouterr().err
    assert not (tmp_path / 'out').exists()
    shutil.copytree(folder / 'out', tmp_path / 'out')
    (tmp_path / 'out' / 'report.html').unlink()
    assert sweep(tmp_path, '--ray', 'auto', '--set', 'seeds=2') == command.PROBLEM_EXIT
    assert '2 of 4' in (tmp_path / 'out' / 'report.html').read_text()
    assert len(runs(tmp_path)) == 2 and not (tmp_path / 'out' / 'ray.log').exists()


def test_an_output_that_is_none(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It would be the current folder."""
    with pytest.raises(SystemExit) as caught:
        command.main([str(tmp_path / 'walks.yaml'), '--output', ''])
    assert caught.value.code == command.PROBLEM_EXIT
    assert 'an empty text names no folder.' in capsys.readouterr().err


def test_an_address_that_is_none(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Ray would start a cluster of its own; the sentence has the address that finds one."""
    with pytest.raises(SystemExit) as caught:
        sweep(folder, '--ray', ' ')
    assert caught.value.code == command.PROBLEM_EXIT
    assert "an empty text is not an address; 'auto' finds the cluster" in capsys.readouterr().err


def test_replay_starts_a_launch(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """With the record and the whole key of the run."""
    started: list[list[str]] = []

    def start(program: str, words: list[str]) -> None:
        started.append(words)
        raise OSError(2, os.strerror(2))

    monkeypatch.setattr(os, 'execvp', start)
    key = runs(folder)[1].key
    assert sweep(folder, '--replay', key[:6]) == command.PROBLEM_EXIT
    assert started == [
        [
            *('ros2', 'launch', 'humanoid_simulation', 'replay.launch.py'),
            *(f'record:={folder}/out/{NAME}', f'key:={key}', 'hands:=false'),
        ]
    ]


@pytest.fixture(name='sandbox')
def _sandbox() -> Iterator[None]:
    """Keep discovery to this test."""
    with ros_sandbox():
        yield


def test_replay(folder: Path, sandbox: None) -> None:
    """The node does the run again until it ends as before, and stops on a signal."""
    key = runs(folder)[1].key
    parameters = ['-p', f'record:={folder}/out/{NAME}', '-p', f"key:='{key}'", '-p', 'speed:=4.0']
    words = module_command('humanoid_simulation.sweep.replay', '--ros-args', *parameters)
    with running_program(words) as program:
        program.wait_for_output(f'Replaying run {key}: fell at ')
        program.wait_for_output(f'The run has ended: {key[:8]}  ')
        assert_clean_exit(program.stop(signal.SIGINT))
    assert f'{runs(folder)[1].result.survived_s:.1f} s  fell' in program.output


def test_replay_of_nothing(sandbox: None) -> None:
    """It says what to give."""
    with running_program(module_command('humanoid_simulation.sweep.replay')) as program:
        report = program.wait_for_exit()
    assert report.status == 1 and "set the parameters 'record' and 'key'" in report.stderr
