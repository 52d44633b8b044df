# SPDX-License-Identifier: Apache-2.0
"""Collect test functions with the marker `launch`."""

from __future__ import annotations

from collections.abc import Callable
import inspect
from typing import Any, NamedTuple, Optional

from launch_pytest._fixture import launch_fixture_of, LaunchFixture
import pytest

_NODES: dict[str, Any] = {
    'function': pytest.Function,
    'class': pytest.Class,
    'module': pytest.Module,
    'package': pytest.Package,
    'session': pytest.Session,
}


class LaunchTest(NamedTuple):
    """Metadata of a test that needs a launch."""

    fixture: LaunchFixture
    is_after_shutdown: bool
    first_part: Optional[str] = None  # the node whose generator this one continues


LAUNCH_TEST: pytest.StashKey[LaunchTest] = pytest.StashKey()


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
        item.stash[LAUNCH_TEST] = LaunchTest(fixture, is_after_shutdown)
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
    result.stash[LAUNCH_TEST] = LaunchTest(fixture, True, first_part=item.nodeid)
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
        if launch is not None and item.stash[LAUNCH_TEST].is_after_shutdown:
            keys.append((last[launch], 1, index))
        else:
            keys.append((index, 0, index))
    items[:] = [item for _, item in sorted(zip(keys, items), key=lambda pair: pair[0])]


def _launch_of(item: pytest.Item) -> Optional[tuple[Any, ...]]:
    """Return a key that is shared by all tests on the same launch."""
    test = item.stash.get(LAUNCH_TEST, None)
    if test is None:
        return None
    node = item.getparent(_NODES[test.fixture.scope]) or item.session
    callspec = getattr(item, 'callspec', None)
    indices = callspec.indices if callspec is not None else {}
    return node, test.fixture.name, indices.get(test.fixture.name)
