# SPDX-License-Identifier: Apache-2.0
"""Check that an engine in a process of its own is like one in this process, and ends with it."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
import signal
import sys

from humanoid_common.testing.processes import is_alive, running_program
from humanoid_common.testing.waiting import wait_until
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.sweep.engine import Done
from humanoid_simulation.sweep.results import RunResult
from humanoid_simulation.sweep.separate_process import SeparateProcess
import pytest

FAKE = """
import os
from pathlib import Path
import time

from humanoid_simulation.errors import SimulationError
from humanoid_simulation.sweep.engine import Done
from humanoid_simulation.sweep.results import RunResult

FOLDER = Path(__file__).parent

class Engine:
    def outcomes(self, runs):
        print('a library speaks', flush=True)
        (FOLDER / 'pid').write_text(str(os.getpid()))
        try:
            for run in runs:
                if run == 'ends':
                    os._exit(7)
                if run == 'raises':
                    raise SimulationError('There is no cluster.')
                if run == 'fails':
                    raise ValueError('a bug')
                while run == 'lasts':
                    time.sleep(0.01)
                yield Done(run, RunResult('stood', 20.0))
        finally:
            (FOLDER / 'cleared').touch()
"""
PROGRAM = """
from pathlib import Path
import sys

sys.path.insert(0, {folder!r})  # for its process, too

def main():
    import fake_engine
    from humanoid_simulation.sweep.separate_process import SeparateProcess
    engine = SeparateProcess(fake_engine.Engine(), 'It', Path({folder!r}, 'log'))
    for outcome in engine.outcomes(['good', 'lasts']):
        print('one is done', flush=True)

if __name__ == '__main__':
    main()
"""


@pytest.fixture
def engine(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> SeparateProcess:
    """Return an engine in another process, which does what the runs say."""
    (tmp_path / 'fake_engine.py').write_text(FAKE)
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delitem(sys.modules, 'fake_engine', raising=False)
    fake = import_module('fake_engine').Engine()
    return SeparateProcess(fake, 'The cluster', tmp_path / 'log')


def test_outcomes_arrive(engine: SeparateProcess, tmp_path: Path) -> None:
    """What libraries print is in the log only."""
    stood = RunResult('stood', 20.0)
    assert [*engine.outcomes(['one', 'two'])] == [Done('one', stood), Done('two', stood)]
    assert (tmp_path / 'log').read_text() == 'a library speaks\n'
    assert (tmp_path / 'cleared').exists()


def test_an_error_of_the_engine_arrives(engine: SeparateProcess, tmp_path: Path) -> None:
    """After what has been done before; if nothing was, there is no log, either."""
    outcomes = engine.outcomes(['good', 'raises'])
    assert next(outcomes).run == 'good'
    with pytest.raises(SimulationError, match=r'^There is no cluster\.$'):
        next(outcomes)
    assert (tmp_path / 'log').exists()
    with pytest.raises(SimulationError, match=r'^There is no cluster\.$'):
        next(engine.outcomes(['raises']))
    assert not (tmp_path / 'log').exists()


@pytest.mark.parametrize(('run', 'status'), [('ends', 7), ('fails', 1)])
def test_the_end_of_the_process_is_an_error(
    engine: SeparateProcess, tmp_path: Path, run: str, status: int
) -> None:
    """What was done before has arrived; the sentence says how it ended, and where to read on."""
    outcomes = engine.outcomes(['good', run])
    assert next(outcomes).run == 'good'
    with pytest.raises(SimulationError) as caught:
        next(outcomes)
    lost = 'The cluster can no longer be reached: the process connected to it'
    assert f'{lost} ended with status {status}' in str(caught.value)
    assert f'{tmp_path}/log has its last output' in str(caught.value)
    assert ('ValueError: a bug' in (tmp_path / 'log').read_text()) == (run == 'fails')


def test_closing_lets_the_engine_clear_up(engine: SeparateProcess, tmp_path: Path) -> None:
    """Also in the middle of a run; the process has ended then."""
    outcomes = engine.outcomes(['good', 'lasts'])
    next(outcomes)
    outcomes.close()
    assert (tmp_path / 'cleared').exists()
    assert not is_alive(int((tmp_path / 'pid').read_text()))


def test_it_ends_with_this_process(engine: SeparateProcess, tmp_path: Path) -> None:
    """After kill -9, too, and clears up."""
    (tmp_path / 'program.py').write_text(PROGRAM.format(folder=str(tmp_path)))
    with running_program([sys.executable, str(tmp_path / 'program.py')]) as program:
        program.wait_for_output('one is done')
        program.send(signal.SIGKILL)
        process = int((tmp_path / 'pid').read_text())
        wait_until(lambda: not is_alive(process))
    assert (tmp_path / 'cleared').exists()
