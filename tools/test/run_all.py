# SPDX-License-Identifier: Apache-2.0
"""Runs every test: the packages of src/ with `colcon test`, then those of tools/.

What fails is run once more at the end, alone. What passes then is unsteady: it is listed, and more
than three of that kind are a failure. Everything together is given three quarters of an hour.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
import os
from pathlib import Path
import signal
import subprocess
import sys
import time
from xml.etree import ElementTree

ROOT = Path(__file__).resolve().parents[2]
LIMIT_S = 45 * 60.0
MOST_UNSTEADY = 3
_LAST_WORDS_S = 10.0
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


def run(suites: Sequence[Suite], limit_s: float = LIMIT_S) -> int:
    """Run the tests; return the exit status."""
    end_s = time.monotonic() + limit_s
    for path in (path for suite in suites for path in suite.reports()):
        path.unlink(missing_ok=True)
    first: dict[str, str] = {}
    last: dict[str, str] = {}
    try:
        failed = [(suite, _run(suite, suite.command, end_s)) for suite in suites]
        for suite, tests in failed:
            first |= tests
            if tests:
                last |= _run(suite, suite.again, end_s)
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
    """List tests, at the end without the reasons, which may be long."""
    for test, reason in tests.items():
        print(f'-- {test}', reason, sep='\n')
    if tests:
        print(f'== {title}: {len(tests)}', *sorted(tests), sep='\n  ')


def _run(suite: Suite, command: Sequence[str], end_s: float) -> dict[str, str]:
    """Run tests; return those that failed, and why."""
    print(f'== {suite.name}', flush=True)
    status = _status(command, end_s)
    failed = {test: why for path in suite.reports() for test, why in _failed(suite.name, path)}
    if status not in _ENDS and not failed:
        failed[f'{suite.name}: the command'] = f'ended with status {status}'
    return failed


def _failed(suite: str, report: Path) -> Iterator[tuple[str, str]]:
    """Yield the tests that failed, and why, of a JUnit file; that it is not there, if so."""
    try:
        cases = ElementTree.parse(report).iter('testcase')
    except (OSError, ElementTree.ParseError) as error:
        yield f'{suite}: there is no result in {report}', str(error)
        return
    for case in cases:
        for what in [*case.findall('failure'), *case.findall('error')]:
            reason = what.text or what.get('message') or ''
            yield f'{suite}: {case.get("classname")}::{case.get("name")}', reason


def _status(command: Sequence[str], end_s: float) -> int:
    """Run a command to its end, or until the time is up."""
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL, start_new_session=True)
    try:
        return process.wait(max(end_s - time.monotonic(), 0.0))
    except subprocess.TimeoutExpired:
        _end(process, signal.SIGABRT)  # Python then writes where its threads are
        raise TimeIsUpError(
            'The tests took too long and were ended. Above is where Python was.'
        ) from None
    except KeyboardInterrupt:
        _end(process, signal.SIGINT)
        raise


def _end(process: subprocess.Popen[bytes], number: int) -> None:
    """Send a signal to a command and what it has started; kill what does not heed it."""
    os.killpg(process.pid, number)
    with suppress(subprocess.TimeoutExpired):
        process.wait(_LAST_WORDS_S)
    with suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def packages() -> Suite:
    """Return the tests of the packages of src/, which colcon runs."""
    names = sorted(path.parent.name for path in ROOT.glob('src/*/package.xml'))
    results = ROOT / 'build'

    def reports() -> list[Path]:
        found = {name: sorted((results / name).glob('test_results/*/*.xml')) for name in names}
        return [path for name in names for path in found[name] or [results / name / 'pytest.xml']]

    watched = 'PYTHONPATH="$PWD/tools/test:$PYTHONPATH" PYTEST_ADDOPTS="-p watchdog" exec "$@"'
    test = ['tools/in_environment', '--underlay', 'bash', '-c', watched, 'bash']
    test += ['colcon', 'test', '--event-handlers', 'console_cohesion-']
    again = [*test, '--packages-select-test-failures', '--pytest-args', '--last-failed']
    return Suite('Packages of src/', [*test, '--pytest-args', '--cache-clear'], again, reports)


def tools() -> Suite:
    """Return the tests of tools/."""
    report = ROOT / 'log' / 'test_tools.xml'
    test = ['tools/in_environment', 'python3', '-m', 'pytest', 'tools']
    test += ['-p', 'tools.test.watchdog', '--durations=40', f'--junit-xml={report}']
    again = [*test, '--last-failed']
    return Suite('tools/', [*test, '--cache-clear'], again, lambda: [report])


if __name__ == '__main__':
    # A shell that starts this in the background lets it ignore Ctrl-C, and nohup lets it ignore
    # SIGHUP, and with it all tests.
    signal.signal(signal.SIGHUP, signal.SIG_DFL)
    for stop in (signal.SIGINT, signal.SIGTERM):
        signal.signal(stop, signal.default_int_handler)
    os.chdir(ROOT)
    sys.exit(run([packages(), tools()]))
