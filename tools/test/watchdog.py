# SPDX-License-Identifier: Apache-2.0
"""
Says at once what failed, and ends a process of tests that hangs, with its stacks.

A plugin of pytest. What a process of tests has started ends with it, even if it is killed. The
time limit of a test raises an error in Python; this one also ends a process whose main thread
hangs in C, with Python's lock, where no signal handler runs.
"""

from __future__ import annotations

from collections.abc import Iterator
import faulthandler
import os
import sys
import uuid

import pytest

sys.path.append(os.path.dirname(__file__))

from leftovers import kill_at_the_end  # noqa: E402

GRACE_S = 120.0
"""How long after the limit of a test."""
_MARK = 'STARTED_BY_TESTS'

_stderr: list[int] = []


def pytest_configure(config: pytest.Config) -> None:
    """Keep what stderr is while no test's output is captured."""
    _stderr.append(os.dup(2))
    if os.environ.pop('PYTEST_PLUGINS', None):  # asked for this module, of this process alone
        folder = os.path.dirname(__file__)
        os.environ['PYTHONPATH'] = os.environ['PYTHONPATH'].removeprefix(f'{folder}:')
    name = uuid.uuid4().hex
    kill_at_the_end(f'{_MARK}={name}', _stderr[0])
    os.environ[_MARK] = name


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_runtest_protocol(item: pytest.Item) -> Iterator[None]:
    """Watch a test, with its fixtures."""
    _watch(_limit_s(item))
    return (yield)


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_runtest_teardown(item: pytest.Item) -> Iterator[None]:
    """Watch the end of a test: pytest has stopped watching if it failed."""
    _watch(_limit_s(item))
    return (yield)


def pytest_runtest_logreport(report: pytest.TestReport) -> None:
    """Say at once what failed: if the time for all tests is up, nothing else would."""
    if report.failed and not _is_worker():
        text = f'\nFAILED {report.nodeid} ({report.when})\n{report.longreprtext}\n'
        os.write(_stderr[0], text.encode(errors='replace'))


def _is_worker() -> bool:
    return 'PYTEST_XDIST_WORKER' in os.environ


def pytest_sessionfinish() -> None:
    """Watch the end of the process."""
    _watch(0.0)


def _limit_s(item: pytest.Item) -> float:
    """Return the time limit of a test."""
    marker = item.get_closest_marker('timeout')
    return float(marker.args[0] if marker else item.config.getini('timeout') or 0.0)


def _watch(limit_s: float) -> None:
    faulthandler.dump_traceback_later(limit_s + GRACE_S, exit=True, file=_stderr[0])
