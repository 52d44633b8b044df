# SPDX-License-Identifier: Apache-2.0
"""Tests of what runs all tests: it repeats what failed, and ends what takes too long."""

from __future__ import annotations

from pathlib import Path
import re
import shutil
import subprocess
import sys
import time
from unittest import mock
from xml.etree import ElementTree

from leftovers import runs
from programs import wait_until
import pytest
import run_all
from run_all import MOST_UNSTEADY, run, Suite

FLAKY = """
from pathlib import Path
import pytest

@pytest.mark.parametrize('number', range({count}))
def test_flaky(number):
    seen = Path(__file__).with_name(f'seen-{{number}}')
    assert seen.exists() or seen.touch()

def test_well():
    with open('runs', 'a') as runs:
        runs.write('x')
"""
BROKEN = 'def test_broken():\n    assert 0\n'
WATCHED_TEST = """
import os

def test_it(pytestconfig):
    assert pytestconfig.pluginmanager.hasplugin('watchdog')
    assert 'PYTEST_PLUGINS' not in os.environ
"""
CRASHED = 'import os\n\ndef test_crashed():\n    os.abort()\n'
HANGING = """
import ctypes

def test_hanging():
    mutex = ctypes.create_string_buffer(64)
    for _ in range(2):
        ctypes.PyDLL(None).pthread_mutex_lock(mutex)
"""
ORPHAN = """
import os
import subprocess

def test_it():
    sleeping = subprocess.Popen(['sleep', '300'], start_new_session=True)
    with open('orphan', 'w') as file:
        file.write(str(sleeping.pid))
    {end}
"""
DYING = """
import os
import time

def {dies}():
    time.sleep(0.1)
    os.abort()

def {lives}():
    time.sleep(0.1)
"""


@pytest.fixture
def suite(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Suite:
    """Return the tests of an empty folder."""
    monkeypatch.chdir(tmp_path)
    # The tests are a process of their own, also if this one is a worker of pytest-xdist.
    monkeypatch.delenv('PYTEST_XDIST_WORKER', raising=False)
    (tmp_path / 'pytest.ini').write_text('[pytest]\n')
    report = tmp_path / 'report.xml'
    command = [sys.executable, '-m', 'pytest', '-q', f'--junit-xml={report}']
    return Suite(
        'mine', [*command, '--cache-clear'], [*command, '--last-failed'], lambda: [report]
    )


@pytest.mark.parametrize(('count', 'status'), [(0, 0), (1, 0), (MOST_UNSTEADY + 1, 1)])
def test_unsteady(
    suite: Suite, tmp_path: Path, capfd: pytest.CaptureFixture[str], count: int, status: int
) -> None:
    """What passes the second time is listed, and only what failed is repeated."""
    (tmp_path / 'test_it.py').write_text(FLAKY.format(count=count))
    assert run([[suite]]) == status
    assert (tmp_path / 'runs').read_text() == 'x'
    listed = re.findall(r'^  (mine: test_it::test_flaky.*)', capfd.readouterr().out, re.MULTILINE)
    assert listed == [f'mine: test_it::test_flaky[{number}]' for number in range(count)]


@pytest.mark.parametrize(
    'text',
    [BROKEN, CRASHED, 'import nothing_of_that_name', ')'],
    ids=['fails', 'crashes', 'cannot import', 'cannot be read'],
)
def test_broken(
    suite: Suite, tmp_path: Path, capfd: pytest.CaptureFixture[str], text: str
) -> None:
    """What fails twice, or cannot run, is a failure, and what is well beside it is none."""
    (tmp_path / 'test_it.py').write_text(text)
    well = Suite('well', ['true'], ['false'], list)
    assert run([[well, suite]]) == 1
    assert '== Failed: 1\n' in capfd.readouterr().out


def test_what_fails_is_said_at_once(
    suite: Suite, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    """Even if the time is up before the end."""
    (tmp_path / 'test_it.py').write_text(BROKEN + HANGING)
    _copy('watchdog.py', 'leftovers.py', to=tmp_path)
    command = [*suite.command, '-p', 'watchdog']
    assert run([[Suite('mine', command, ['true'], suite.reports)]], limit_s=10.0) == 1
    assert 'FAILED test_it.py::test_broken (call)' in capfd.readouterr().err


def _copy(*names: str, to: Path) -> None:
    for name in names:
        shutil.copy(Path(__file__).parent / name, to)


@pytest.mark.parametrize(
    'end', ['assert 0', 'os.abort()', 'os._exit(0)', 'os.kill(os.getpid(), 9)']
)
def test_nothing_outlives_its_tests(suite: Suite, tmp_path: Path, end: str) -> None:
    """What a process of tests has started ends with it, also in a session of its own."""
    (tmp_path / 'test_it.py').write_text(ORPHAN.format(end=end))
    _copy('watchdog.py', 'leftovers.py', to=tmp_path)
    command = [*suite.command, '-p', 'watchdog']
    run([[Suite('mine', command, ['true'], suite.reports)]])
    orphan = int((tmp_path / 'orphan').read_text())
    wait_until(lambda: not runs(orphan), 30.0, 'the end of what the test started')


@pytest.mark.parametrize('arguments', [[], ['7'], ['seven', 'A=b'], ['7', 'A']])
def test_what_ends_leftovers_says_how_it_is_used(root: Path, arguments: list[str]) -> None:
    """Without a process and a mark there is nothing to wait for, and nothing is killed."""
    program = root / 'tools' / 'test' / 'leftovers.py'
    done = subprocess.run(
        [sys.executable, '-S', program, *arguments], capture_output=True, text=True, check=False
    )
    assert done.returncode == 1
    assert done.stderr.startswith('usage: leftovers.py PID MARK')


def test_processes_that_die_are_replaced(suite: Suite, tmp_path: Path) -> None:
    """Each test in which a process dies fails, once, and all others run, in every file."""
    _copy('../conftest.py', to=tmp_path)
    dies, lives = 'test_{}_dies', 'test_{}_lives'
    for number in range(4):
        text = DYING.format(dies=dies.format(number), lives=lives.format(number))
        (tmp_path / f'test_{number}.py').write_text(text)
    command = [*suite.command, '-n', '2', '--dist', 'loadfile', '--no-loadscope-reorder']
    assert run([[Suite('mine', command, ['true'], suite.reports)]]) == 1
    cases = list(ElementTree.parse(tmp_path / 'report.xml').iter('testcase'))
    failed = [case.get('name') for case in cases if case.find('error') is not None]
    assert sorted(failed) == [dies.format(number) for number in range(4)]
    passed = {case.get('name') for case in cases} - set(failed)
    assert passed == {lives.format(number) for number in range(4)}


class Process:
    """What pytest-xdist knows of a process of tests, which has died at some time."""

    gateway = mock.Mock()
    shutting_down = is_dead = False

    def __init__(self) -> None:
        self.told: list[int] = []

    def send_runtest_some(self, indices: list[int]) -> None:
        """Take the indices of more tests."""
        if self.is_dead:
            raise OSError('cannot send (already closed?)')
        self.told += indices

    def shutdown(self) -> None:
        """Take the end."""


def test_a_process_dies_when_it_is_given_more(pytestconfig: pytest.Config) -> None:
    """What it was given in vain is done by another one; only the test in which it died fails."""
    path = Path(__file__).parents[1] / 'conftest.py'
    conftest = pytestconfig.pluginmanager.get_plugin(str(path))
    config = mock.Mock()
    config.getvalue = {'dist': 'loadfile', 'tx': ['2*popen']}.get
    scheduler = conftest.pytest_xdist_make_scheduler(config, None)
    tests = [f'test_{file}.py::test_{name}' for file in range(4) for name in 'abc']
    dying, other = Process(), Process()
    for each in (dying, other):
        scheduler.add_node(each)
        scheduler.add_node_collection(each, tests)
    scheduler.schedule()
    dying.is_dead = True
    scheduler.mark_test_complete(dying, 0)
    assert scheduler.remove_node(dying) == tests[1]
    for index in other.told:  # which grows
        scheduler.mark_test_complete(other, index)
    assert sorted([0, 1, *other.told]) == [*range(len(tests))]
    assert scheduler.tests_finished


def test_some_at_a_time(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Commands of a round begin in their order, when there is room; the next round waits."""
    monkeypatch.setattr(run_all, 'CORES', 2)
    written = tmp_path / 'written'

    def suite(name: str, s: float, cores: float = 1.0) -> Suite:
        command = f'echo +{name} >> {written}; sleep {s}; echo -{name} >> {written}'
        return Suite(name, ['sh', '-c', command], ['false'], list, cores)

    large = [suite('d', 0.0, 1.5), suite('e', 0.5, 0.5), suite('f', 0.0, 4.0)]
    assert run([[suite('a', 3.0), suite('b', 0.5), suite('c', 0.5)], large]) == 0
    begun_or_ended = written.read_text().split()
    assert set(begun_or_ended[:2]) == {'+a', '+b'}
    assert begun_or_ended[2:6] == ['-b', '+c', '-c', '-a']
    assert set(begun_or_ended[6:9]) == {'+d', '-d', '+e'}
    assert begun_or_ended[9:] == ['-e', '+f', '-f']


@pytest.mark.parametrize('command', ['false', 'true'])
def test_no_results(suite: Suite, capfd: pytest.CaptureFixture[str], command: str) -> None:
    """A command that leaves no results has failed, whatever its status."""
    assert run([[Suite('mine', [command], [command], suite.reports)]]) == 1
    assert 'mine: there is no result in ' in capfd.readouterr().out


def test_a_whole_day(suite: Suite, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """When the time is up, tests that hang in C with Python's lock are ended with their stacks."""
    (tmp_path / 'test_it.py').write_text(HANGING)
    began_s = time.monotonic()
    assert run([[suite]], limit_s=3.0) == 1
    assert time.monotonic() - began_s < 60.0
    errors = capfd.readouterr().err
    assert 'in test_hanging' in errors and 'took too long' in errors


def test_tests_of_packages_are_watched(suite: Suite, root: Path, tmp_path: Path) -> None:
    """Also where colcon sets pytest's options; what the tests start is not."""
    (tmp_path / 'test_it.py').write_text(WATCHED_TEST)
    command = ['env', '-C', str(root), *run_all.WATCHED, 'env', '-C', str(tmp_path)]
    command += ['PYTEST_ADDOPTS=--tb=short', *suite.command]
    assert run([[Suite('mine', command, ['false'], suite.reports)]]) == 0


def test_watchdog(suite: Suite, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """A test that hangs in C is ended with its stack, some time after its time limit."""
    _copy('watchdog.py', 'leftovers.py', to=tmp_path)
    source = (tmp_path / 'watchdog.py').read_text()
    (tmp_path / 'watchdog.py').write_text(source.replace('GRACE_S = 120.0', 'GRACE_S = 2.0'))
    (tmp_path / 'test_it.py').write_text(HANGING)
    command = [*suite.command, '-p', 'watchdog', '-o', 'timeout=1']
    assert run([[Suite('mine', command, ['true'], suite.reports)]]) == 1
    errors = capfd.readouterr().err
    assert 'Timeout (0:00:03)!' in errors and 'in test_hanging' in errors
