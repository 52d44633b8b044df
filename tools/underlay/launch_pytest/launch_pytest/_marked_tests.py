# SPDX-License-Identifier: Apache-2.0
"""Collect and run test functions with the marker `launch`."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
import inspect
from typing import Any, NamedTuple, Optional

from launch_pytest._fixture import launch_fixture_of, LaunchFixture
from launch_pytest._session import LaunchSession, SESSIONS
import pytest

_NODES: dict[str, Any] = {
    'function': pytest.Function,
    'class': pytest.Class,
    'module': pytest.Module,
    'package': pytest.Package,
    'session': pytest.Session,
}

_END = object()


class _LaunchTest(NamedTuple):
    """Metadata of a test that needs a launch."""

    fixture: LaunchFixture
    is_after_shutdown: bool
    first_part: Optional[str] = None  # the node whose generator this one continues


_LAUNCH_TEST: pytest.StashKey[_LaunchTest] = pytest.StashKey()


def collect(
    collector: Any,
    name: str,
    function: Callable[..., Any],
    mark: pytest.Mark,
) -> list[pytest.Function]:
    """
    Collect the items of a test function with the marker `launch`.

    A generator function is split if it shares its launch with other tests: the code after its
    `yield` becomes a separate item, which runs after shutdown.

    Parameters
    ----------
    collector
        The module or class that contains the function.
    name, function
        The test function.
    mark
        The marker, with `fixture` and optionally `shutdown`.

    Returns
    -------
    list of pytest.Function
        The items, with their LaunchTest in the stash.

    Raises
    ------
    pytest.UsageError
        The marker does not refer to a launch fixture.

    """
    fixture = launch_fixture_of(mark, f'{collector.nodeid}::{name}')
    pytest.mark.usefixtures(fixture.name)(getattr(function, '__func__', function))
    is_after_shutdown = bool(mark.kwargs.get('shutdown', False))
    items: list[pytest.Function] = list(collector._genfunctions(name, function))
    for item in items:
        item.stash[_LAUNCH_TEST] = _LaunchTest(fixture, is_after_shutdown)
    if fixture.scope == 'function' or is_after_shutdown or not _is_generator(function):
        return items
    return items + [_second_part(item, fixture) for item in items]


def _is_generator(function: Callable[..., Any]) -> bool:
    return inspect.isgeneratorfunction(function) or inspect.isasyncgenfunction(function)


def _second_part(item: pytest.Function, fixture: LaunchFixture) -> pytest.Function:
    """Create the item for the part of a test after its `yield`, which runs after shutdown."""
    result: pytest.Function = pytest.Function.from_parent(
        item.parent,
        name=f'{item.name}[shutdown]',
        originalname=item.originalname,
        callspec=getattr(item, 'callspec', None),
        fixtureinfo=item._fixtureinfo,
    )
    result.stash[_LAUNCH_TEST] = _LaunchTest(fixture, True, first_part=item.nodeid)
    return result


def put_after_shutdown_last(items: list[pytest.Item]) -> None:
    """
    Move tests that run after shutdown behind all other tests on the same launch.

    Parameters
    ----------
    items
        All tests of the run, reordered in place.

    """
    launches = [_launch_of(item) for item in items]
    last = {launch: index for index, launch in enumerate(launches) if launch is not None}
    keys = []
    for index, (item, launch) in enumerate(zip(items, launches)):
        if launch is not None and item.stash[_LAUNCH_TEST].is_after_shutdown:
            keys.append((last[launch], 1, index))
        else:
            keys.append((index, 0, index))
    items[:] = [item for _, item in sorted(zip(keys, items), key=lambda pair: pair[0])]


def _launch_of(item: pytest.Item) -> Optional[tuple[Any, ...]]:
    """Return a key that is shared by all tests on the same launch."""
    test = item.stash.get(_LAUNCH_TEST, None)
    if test is None:
        return None
    node = item.getparent(_NODES[test.fixture.scope]) or item.session
    callspec = getattr(item, 'callspec', None)
    indices = callspec.indices if callspec is not None else {}
    return node, test.fixture.name, indices.get(test.fixture.name)


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


def run(item: pytest.Function, test: _LaunchTest) -> None:
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


def _run(item: pytest.Function, test: _LaunchTest, session: LaunchSession) -> None:
    if test.is_after_shutdown:
        session.shutdown()
    if test.first_part is not None:
        if test.first_part not in session.suspended:
            pytest.skip('the test has not reached its yield')
        _resume(session, session.suspended.pop(test.first_part))
        return
    function = partial(item.obj, **_arguments(item))
    if inspect.iscoroutinefunction(item.obj):
        session.wait_for(function)
    elif not (inspect.isgeneratorfunction(item.obj) or inspect.isasyncgenfunction(item.obj)):
        session.call(function)
    else:
        _run_parts(item, test, session, function())


def _arguments(item: pytest.Function) -> dict[str, Any]:
    """Return the values of the fixtures and parameters that a test takes by name."""
    parameters = inspect.signature(item.obj).parameters.values()
    taken = [each.name for each in parameters if each.default is each.empty]
    return {name: item.funcargs[name] for name in taken if name in item.funcargs}


def _run_parts(
    item: pytest.Function,
    test: _LaunchTest,
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
        pytest.fail('a launch test can have only one yield', pytrace=False)


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
    test = item.stash.get(_LAUNCH_TEST, None)
    if test is not None:
        run(item, test)
    return test is not None
