# SPDX-License-Identifier: Apache-2.0
"""Run test functions with the marker `launch`."""

from __future__ import annotations

from functools import partial
import inspect
from typing import Any

from launch_pytest._collection import LAUNCH_TEST, LaunchTest
from launch_pytest._session import LaunchSession, SESSIONS
import pytest

_END = object()


def session_of(item: pytest.Item, fixture_name: str) -> LaunchSession:
    """
    Return the launch session that a fixture has started for a test.

    Parameters
    ----------
    item
        The test.
    fixture_name
        The name of the fixture.

    Raises
    ------
    RuntimeError
        The fixture has not started a launch for the test.

    """
    for node in reversed(item.listchain()):
        session = node.stash.get(SESSIONS, {}).get(fixture_name)
        if session is not None:
            return session
    raise RuntimeError(f"the fixture '{fixture_name}' has not launched anything for {item.nodeid}")


def run(item: pytest.Function, test: LaunchTest) -> None:
    """
    Run a test; on failure, add the state of the processes to its report.

    Parameters
    ----------
    item
        The test function.
    test
        The launch that the test needs, and when it runs.

    """
    session = session_of(item, test.fixture.name)
    try:
        _run(item, test, session)
    except BaseException as error:
        if not isinstance(error, pytest.skip.Exception):
            item.add_report_section('call', 'launch', session.report())
        raise


def _run(item: pytest.Function, test: LaunchTest, session: LaunchSession) -> None:
    if test.is_after_shutdown:
        session.shutdown()
    if test.first_part is not None:
        if test.first_part not in session.suspended:
            pytest.skip('the test has not come to its yield')
        _resume(session, session.suspended.pop(test.first_part))
        return
    arguments = {name: item.funcargs[name] for name in item._fixtureinfo.argnames}
    function = partial(item.obj, **arguments)
    if inspect.iscoroutinefunction(item.obj):
        session.wait_for(function)
    elif not (inspect.isgeneratorfunction(item.obj) or inspect.isasyncgenfunction(item.obj)):
        session.call(function)
    else:
        _run_parts(item, test, session, function())


def _run_parts(
    item: pytest.Function,
    test: LaunchTest,
    session: LaunchSession,
    generator: Any,
) -> None:
    """Run a test to its `yield`, and beyond if it does not share its launch."""
    if _step(session, generator) is _END:
        return
    if test.fixture.scope == 'function' or test.is_after_shutdown:
        session.shutdown()
        _resume(session, generator)
    else:
        session.suspended[item.nodeid] = generator


def _resume(session: LaunchSession, generator: Any) -> None:
    if _step(session, generator) is not _END:
        pytest.fail('a launch test can have one yield only', pytrace=False)


def _step(session: LaunchSession, generator: Any) -> Any:
    """Advance a generator to its next `yield` or its end."""
    if inspect.isasyncgen(generator):
        return session.wait_for(partial(_next, generator))
    return session.call(partial(next, generator, _END))


async def _next(generator: Any) -> Any:
    return await anext(generator, _END)


def run_marked(item: pytest.Function) -> bool:
    """
    Run a test if it needs a launch; return whether it was run.

    Parameters
    ----------
    item
        Any test function.

    """
    test = item.stash.get(LAUNCH_TEST, None)
    if test is not None:
        run(item, test)
    return test is not None
