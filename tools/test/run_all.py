# SPDX-License-Identifier: Apache-2.0
"""Runs every test of the workspace.

Those of tools/ in several processes, and beside them those of src/ with `colcon test`, as many
packages at a time as there is room for; then what builds src/. Two kinds are left out: ament's
linters, which `make check` runs for all packages at once, and stories, which `make stories` runs.

What fails is run once more at the end, alone. What passes then is unsteady: it is listed, and more
than three of that kind are a failure. Everything together is given 45 minutes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, suppress
from dataclasses import dataclass, replace
import os
from pathlib import Path
import signal
import subprocess
import sys
from tempfile import TemporaryFile
import time
from typing import IO
from xml.etree import ElementTree

ROOT = Path(__file__).resolve().parents[2]
LIMIT_S = 45 * 60.0
MOST_UNSTEADY = 3
CORES = min(os.cpu_count() or 1, 12)
"""Processors that tests may keep busy: each process of tests reserves some of the DDS domains.

With more packages at once, simulators take processors from each other and fall behind real time.
"""
LONGEST = {
    'humanoid_simulation': 0.75,
    'robot_mcp': 0.2,
    'llm_planner': 0.2,
    'humanoid_bringup': 1.0,
    'humanoid_navigation': 0.9,
    'humanoid_manipulation': 0.7,
    'humanoid_perception': 0.4,
    'humanoid_control': 0.4,
    'voice_control': 0.9,
}
"""Packages whose tests take minutes, in the order in which they begin, before the others.

Each with the processors that it keeps busy on average: its CPU time over its duration. The longest
comes first, beside tools/, and those that wait much fill what is left of the processors.
"""
WATCHED = (
    *('bash', '-c', 'PYTHONPATH="$PWD/tools/test:$PYTHONPATH" PYTEST_PLUGINS=watchdog exec "$@"'),
    'bash',
)
"""What stands before a command whose tests the watchdog watches.

colcon gives pytest its own PYTEST_ADDOPTS.
"""
_CORES_OF_OTHERS = 0.5
_LEFT_OUT = ('-m', 'not linter and not story')
_LAST_WORDS_S = 10.0
_POLL_S = 0.2
_ENDS = (0, 1, 5)  # of pytest: passed, failed, nothing to run


class TimeIsUpError(Exception):
    """The tests have taken too long together."""


@dataclass(frozen=True)
class Suite:
    """Tests that one command runs, and another once more."""

    name: str
    command: Sequence[str]
    again: Sequence[str]
    """Runs only what failed, or everything where that is not known."""
    reports: Callable[[], Sequence[Path]]
    """Returns the JUnit files that are there after the command, whether it wrote them or not."""
    cores: float = 1.0
    """Processors that it keeps busy, on average."""


def run(rounds: Sequence[Sequence[Suite]], limit_s: float = LIMIT_S) -> int:
    """Run the tests, those of a round beside each other; return the exit status."""
    end_s = time.monotonic() + limit_s
    suites = [suite for each in rounds for suite in each]
    for path in (path for suite in suites for path in suite.reports()):
        path.unlink(missing_ok=True)
    first: dict[str, str] = {}
    last: dict[str, str] = {}
    try:
        found = [failed for each in rounds for failed in _run(each, end_s)]
        for suite, failed in zip(suites, found, strict=True):
            first |= failed
            if failed:
                last |= _run([replace(suite, command=suite.again)], end_s)[0]
    except TimeIsUpError as error:
        print(error, file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 128 + signal.SIGINT
    unsteady = {test: why for test, why in first.items() if test not in last}
    _list('Failed once, and passed alone', unsteady)
    _list('Failed', last)
    if len(unsteady) > MOST_UNSTEADY:
        print(f'More than {MOST_UNSTEADY} tests are unsteady.')
    return 1 if last or len(unsteady) > MOST_UNSTEADY else 0


def _list(title: str, tests: dict[str, str]) -> None:
    """List tests without the reasons, which may be long and stand where their suite ended."""
    if tests:
        print(f'== {title}: {len(tests)}', *sorted(tests), sep='\n  ')


def _failed(suite: Suite, status: int) -> dict[str, str]:
    """Return the tests of a suite that failed, and why; its command ended with a status."""
    failed = {
        f'{suite.name}: {test}': why for path in suite.reports() for test, why in _read(path)
    }
    if status not in _ENDS and not failed:
        failed[f'{suite.name}: the command'] = f'ended with status {status}'
    return failed


def _read(report: Path) -> Iterator[tuple[str, str]]:
    """Yield the tests that failed, and why, of a JUnit file; that it is not there, if so."""
    try:
        cases = ElementTree.parse(report).iter('testcase')
    except (OSError, ElementTree.ParseError) as error:
        yield f'there is no result in {report}', str(error)
        return
    for case in cases:
        for what in [*case.findall('failure'), *case.findall('error')]:
            name = f'{case.get("classname")}::{case.get("name")}'
            yield name, what.text or what.get('message') or ''


def _run(suites: Sequence[Suite], end_s: float) -> list[dict[str, str]]:
    """Run commands, each to its end, in their order; return what failed, and why.

    One begins when there are enough of the `CORES` for it. The output of one that is alone is seen
    while it runs, that of several when each has ended.
    """
    waiting = list(enumerate(suites))[::-1]
    running: dict[int, tuple[subprocess.Popen[bytes], IO[bytes] | None]] = {}
    failed: list[dict[str, str]] = [{} for _ in suites]
    with ExitStack() as stack:
        try:
            while waiting or running:
                while waiting and _has_room([suites[index] for index in running], waiting[-1][1]):
                    index, suite = waiting.pop()
                    print(f'== {suite.name}', flush=True)
                    output = stack.enter_context(TemporaryFile()) if len(suites) > 1 else None
                    running[index] = _start(suite, output), output
                for index in _wait_for_one(running, end_s):
                    process, output = running.pop(index)
                    _show(suites[index], output)
                    failed[index] = _failed(suites[index], process.returncode)
                    for test, reason in failed[index].items():
                        print(f'-- failed: {test}', reason, sep='\n', flush=True)
                    if failed[index]:
                        _show_machine()
        except BaseException as error:
            stopped = isinstance(error, KeyboardInterrupt)
            for index, (process, output) in running.items():
                # Upon SIGABRT, Python writes where its threads are.
                _end(process, signal.SIGINT if stopped else signal.SIGABRT)
                _show(suites[index], output)
            raise
    return failed


def _has_room(running: Sequence[Suite], suite: Suite) -> bool:
    """Return whether there are processors for one more."""
    return not running or sum(each.cores for each in [*running, suite]) <= CORES


def _wait_for_one(
    running: dict[int, tuple[subprocess.Popen[bytes], IO[bytes] | None]], end_s: float
) -> list[int]:
    """Wait until at least one command has ended; return the indices of those."""
    while True:
        ended = [index for index, (process, _) in running.items() if process.poll() is not None]
        if ended:
            return ended
        if time.monotonic() > end_s:
            raise TimeIsUpError('The tests took too long and were ended: see above.')
        time.sleep(_POLL_S)


def _show(suite: Suite, output: IO[bytes] | None) -> None:
    """Print what a command wrote while others ran beside it."""
    if output is not None:
        output.seek(0)
        text = output.read().decode(errors='replace')
        print(f'== {suite.name} has ended', text, sep='\n', flush=True)


def _show_machine() -> None:
    """Print what else the machine is doing: what has failed may have come too late."""
    print('Load of the last 1, 5 and 15 minutes:', *map('{:.1f}'.format, os.getloadavg()))
    for path in ('/proc/meminfo', *(f'/proc/pressure/{name}' for name in ('cpu', 'io', 'memory'))):
        with suppress(OSError):  # kernels without pressure stall information
            print(path, *Path(path).read_text().splitlines()[:3], sep='\n  ')
    with suppress(OSError):  # where there is no ps
        columns = 'pid,ppid,etimes,times,rss,args'
        busy = subprocess.run(
            ['ps', '-ww', '-eo', columns, '--sort=-times'], capture_output=True, text=True
        ).stdout
        print(*(line[:160] for line in busy.splitlines()[:16]), sep='\n', flush=True)


def _start(suite: Suite, output: IO[bytes] | None) -> subprocess.Popen[bytes]:
    """Start a command in a process group of its own."""
    return subprocess.Popen(
        suite.command,
        stdin=subprocess.DEVNULL,
        stdout=output,
        stderr=output and subprocess.STDOUT,
        start_new_session=True,
    )


def _end(process: subprocess.Popen[bytes], number: int) -> None:
    """Send a signal to a command and what it has started; kill what does not heed it."""
    if process.poll() is not None:
        return
    os.killpg(process.pid, number)
    with suppress(subprocess.TimeoutExpired):
        process.wait(_LAST_WORDS_S)
    with suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def packages() -> list[Suite]:
    """Return the tests of the packages of src/, each run by colcon, the longest first."""
    names = {path.parent.name for path in ROOT.glob('src/*/package.xml')}
    first = [name for name in LONGEST if name in names]
    return [_package(name) for name in [*first, *sorted(names - LONGEST.keys())]]


def _package(name: str) -> Suite:
    """Return the tests of a package."""
    results = ROOT / 'build' / name

    def reports() -> list[Path]:
        return sorted(results.glob('test_results/*/*.xml')) or [results / 'pytest.xml']

    test = ['tools/in_environment', '--underlay', *WATCHED]
    test += ['colcon', '--log-base', f'log/tests of {name}', 'test']
    test += ['--executor', 'sequential', '--event-handlers', 'console_cohesion-']
    test += ['--packages-select', name]
    again = [*test, '--packages-select-test-failures', '--pytest-args', *_LEFT_OUT]
    again += ['--last-failed']
    cores = LONGEST.get(name, _CORES_OF_OTHERS)
    test += ['--pytest-args', *_LEFT_OUT, '--cache-clear']
    return Suite(name, test, again, reports, cores)


def tools() -> Suite:
    """Return the tests of tools/ that do not care what runs beside them."""
    # These tests wait much: with three processes on two cores, beside a package, hardly any time
    # is idle; with two, a sixth was.
    workers = CORES * 3 // 2
    shared = ['-n', str(workers), '--dist', 'loadfile', '--no-loadscope-reorder']
    suite = _pytest('tools/', ['tools', '-m', 'not alone'], shared)
    return replace(suite, cores=CORES / 2)


def alone() -> Suite:
    """Return the tests of tools/ that build src/, from which all others run."""
    return _pytest('what builds src/', ['tools/test/test_docs.py', '-m', 'alone'], [])


def _pytest(name: str, what: list[str], first: list[str]) -> Suite:
    """Return tests of tools/; the first time they run with further arguments."""
    file = name.replace('/', '').replace(' ', '_')
    report = ROOT / 'log' / f'test_{file}.xml'
    test = ['tools/in_environment', 'python3', '-m', 'pytest', *what]
    test += ['-p', 'tools.test.watchdog', '--durations=40', f'--junit-xml={report}']
    test += ['-o', f'cache_dir={ROOT / "log" / f"cache_{file}"}']
    return Suite(
        name, [*test, *first, '--cache-clear'], [*test, '--last-failed'], lambda: [report]
    )


if __name__ == '__main__':
    # A shell that starts this in the background lets it ignore Ctrl-C, and nohup lets it ignore
    # SIGHUP, and with it all tests.
    signal.signal(signal.SIGHUP, signal.SIG_DFL)
    for stop in (signal.SIGINT, signal.SIGTERM):
        signal.signal(stop, signal.default_int_handler)
    os.chdir(ROOT)
    sys.exit(run([[tools(), *packages()], [alone()]]))
