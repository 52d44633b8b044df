# SPDX-License-Identifier: Apache-2.0
"""Check that runs are done once, whatever happens to processes; with runs that take no time."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
import json
from pathlib import Path
import signal
import sys

from humanoid_common.testing.processes import is_alive, running_program
from humanoid_common.testing.waiting import wait_until
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.sweep.conditions import Conditions, Run
from humanoid_simulation.sweep.engine import Crashed, Done, Notice
from humanoid_simulation.sweep.experiment import Experiment
from humanoid_simulation.sweep.local_processes import LocalProcesses
from humanoid_simulation.sweep.record import find_run, NAME, Record
from humanoid_simulation.sweep.results import RunResult
from humanoid_simulation.sweep.sweeping import Sweep
import pytest

RUNS = tuple(Run(Conditions(seed=seed), f'{seed:016x}') for seed in range(8))
STOOD = RunResult('stood', 20.0)
VERSION = 'v1'
FAKE = """
import os
from pathlib import Path
import signal
import time

from humanoid_simulation.sweep.results import RunResult

FOLDER = Path(__file__).parent

def note(seed):
    with (FOLDER / 'done').open('a') as stream:
        stream.write(f'{os.getpid()} {seed}\\n')

def work(seed):
    note(seed)
    if seed == 1 and len((FOLDER / 'done').read_text().splitlines()) < 4:
        os.kill(os.getpid(), signal.SIGKILL)
    if seed == 2:
        os._exit(3)
    if seed == 3:
        raise ValueError('a bug')
    return RunResult('stood', 20.0)

def patient(run):
    note(run.conditions.seed)
    while run.conditions.seed >= 4 and not (FOLDER / 'go').exists():
        time.sleep(0.01)
    return RunResult('stood', 20.0)
"""
PROGRAM = """
from pathlib import Path
import sys

sys.path[:0] = [{folder!r}, {tests!r}]  # for its processes, too

def main():
    import fake_runs
    import test_sweep_engine as test
    from humanoid_simulation.sweep.local_processes import LocalProcesses
    with test.Record(Path({folder!r})) as record:
        test.sweep(record).run(LocalProcesses(fake_runs.patient, 1))

if __name__ == '__main__':
    main()
"""


@pytest.fixture
def fake(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a folder with runs that other processes can import."""
    (tmp_path / 'fake_runs.py').write_text(FAKE)
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delitem(sys.modules, 'fake_runs', raising=False)
    return tmp_path


def sweep(record: Record, say: Callable[[str, bool], None] = lambda line, stays: None) -> Sweep:
    """Return a sweep of all runs."""
    return Sweep(Experiment('fake', RUNS, ()), record, VERSION, say)


def test_crashes_are_retried_once_and_reported(fake: Path) -> None:
    """Killed once: done. Twice, or a bug: named, and the others are done all the same."""
    work = import_module('fake_runs').work
    # Any object is a run to the engine; these need no imports in the processes.
    outcomes = [*LocalProcesses(work, 1).outcomes([*range(5)])]
    assert sorted(each.run for each in outcomes if isinstance(each, Done)) == [0, 1, 4]
    crashes = [each for each in outcomes if isinstance(each, Crashed)]
    last = {each.run: each for each in crashes}
    assert len(crashes) == 5 and 'ended by SIGKILL' in last[1].reason
    assert not last[1].is_final and last[2].is_final and last[3].is_final
    assert 'ended with status 3' in last[2].reason
    assert 'ValueError: a bug' in last[3].reason


def test_a_crash_is_recorded_and_tried_again_by_the_next_command(tmp_path: Path) -> None:
    """It is not finished; the report of the first command has its reason."""

    class Crashing:
        def outcomes(self, runs):
            yield Notice('There is a machine')
            yield Done(runs[0], STOOD)
            yield Crashed(runs[1], 1, 'no <memory>')
            yield Crashed(runs[1], 2, 'no <memory>')

    said: list[str] = []
    with Record(tmp_path) as record:
        one = sweep(record, lambda line, stays: said.append(line))
        one.run(Crashing())
        assert one.crashed == [RUNS[1].key]
        assert 'no &lt;memory&gt;' in one.report('replay').html()
        assert '1 crashed twice' in one.conclusion(tmp_path)
    assert said[1] == 'There is a machine'
    assert f'Run {RUNS[1].key} crashed: no <memory>; it is tried once more' in said
    with Record(tmp_path) as record:
        assert record.left(RUNS, VERSION) == [*RUNS[1:]] and len(record.crashes) == 2


def test_after_kill_9_no_finished_run_is_repeated(fake: Path) -> None:
    """The workers end as well; the next command does what is left, and the record is whole."""
    (fake / 'program.py').write_text(
        PROGRAM.format(folder=str(fake), tests=str(Path(__file__).parent))
    )
    command = [sys.executable, str(fake / 'program.py')]
    with running_program(command) as program:
        wait_until(lambda: len(lines(fake / NAME)) == 4 and len(lines(fake / 'done')) == 5)
        program.send(signal.SIGKILL)
        worker = int(lines(fake / 'done')[-1].split()[0])
        wait_until(lambda: not is_alive(worker))
    # What kill -9 can leave at worst: a line that is cut off.
    with (fake / NAME).open('a') as stream:
        stream.write('{"version":"v1","key":"00000')
    (fake / 'go').touch()
    patient = import_module('fake_runs').patient
    with Record(fake) as record:
        sweep(record).run(LocalProcesses(patient, 1))
    assert [json.loads(line)['key'] for line in lines(fake / NAME)] == [run.key for run in RUNS]
    seeds = [int(line.split()[1]) for line in lines(fake / 'done')]
    assert seeds == [0, 1, 2, 3, 4, 4, 5, 6, 7]


def test_a_record_is_for_one_process_and_one_version(tmp_path: Path) -> None:
    """Another one is told so; runs of another version of the code are to be done again."""
    with Record(tmp_path) as record:
        record.add(RUNS[0], VERSION, STOOD)
        with pytest.raises(SimulationError, match='Another sweep is writing'):
            Record(tmp_path)
    with Record(tmp_path) as record:
        assert record.left(RUNS, VERSION) == [*RUNS[1:]]
        assert record.left(RUNS, 'v2') == [*RUNS]
        assert record.of(RUNS, VERSION)[0].result == STOOD


def test_an_empty_record_can_be_removed(tmp_path: Path) -> None:
    """With the folders that were made for it, but with nothing else; another sweep goes on."""
    (tmp_path / 'mine').mkdir()
    for folder in (tmp_path / 'mine', tmp_path / 'a' / 'b'):
        with Record(folder) as record:
            assert record.remove_if_empty()
    assert [*tmp_path.rglob('*')] == [tmp_path / 'mine']
    with Record(tmp_path / 'a') as record:
        record.add(RUNS[0], VERSION, STOOD)
        assert not record.remove_if_empty()
    assert len(lines(tmp_path / 'a' / NAME)) == 1


def test_a_damaged_record(tmp_path: Path) -> None:
    """The line is named; nothing is deleted without being asked."""
    with Record(tmp_path) as record:
        record.add(RUNS[0], VERSION, STOOD)
    content = (tmp_path / NAME).read_text()
    (tmp_path / NAME).write_text(f'garbage\n{content}')
    with pytest.raises(SimulationError, match='line 1, is damaged. Delete that line'):
        Record(tmp_path)
    assert (tmp_path / NAME).read_text() == f'garbage\n{content}'


def test_a_run_that_cannot_be_recorded(tmp_path: Path) -> None:
    """It is said in a sentence."""
    (tmp_path / 'file').touch()
    with pytest.raises(SimulationError, match='cannot be written: Not a directory'):
        Record(tmp_path / 'file' / 'sweep')


def test_a_run_is_found_by_the_first_digits_of_its_key(tmp_path: Path) -> None:
    """As long as they are enough."""
    with Record(tmp_path) as record:
        for run in RUNS:
            record.add(run, VERSION, STOOD)
    path = tmp_path / NAME
    assert find_run(path, RUNS[3].key).conditions['seed'] == 3
    with pytest.raises(SimulationError, match='8 runs have a key that begins with'):
        find_run(path, '000')
    with pytest.raises(SimulationError, match='No finished run'):
        find_run(path, 'f')


def lines(path: Path) -> list[str]:
    """Return the lines of a file that may not exist yet."""
    return path.read_text().splitlines() if path.exists() else []
