# SPDX-License-Identifier: Apache-2.0
"""
Pytest plugin.

It is loaded in every pytest run, so it imports the rest only for tests with the marker.
"""

from __future__ import annotations

import sys
from typing import Any, Optional, TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from launch import LaunchContext, LaunchService
    from launch_pytest._session import LaunchSession

_MARKER = 'launch'


def pytest_configure(config: pytest.Config) -> None:
    """
    Register the marker `launch`.

    Parameters
    ----------
    config
        The configuration of the pytest run.

    """
    config.addinivalue_line(
        'markers',
        f'{_MARKER}(*, fixture, shutdown=False): runs the test while the launch of a fixture '
        'runs, or after its shutdown',
    )


@pytest.hookimpl(tryfirst=True)
def pytest_pycollect_makeitem(
    collector: Any,
    name: str,
    obj: object,
) -> Optional[list[pytest.Function]]:
    """
    Collect a test function that has the marker.

    Parameters
    ----------
    collector
        The module or class that is being collected.
    name, obj
        The name and the value of an attribute of the collector.

    Returns
    -------
    list of pytest.Function or None
        None leaves the object to other plugins.

    """
    if not collector.istestfunction(obj, name):
        return None
    mark = _mark(collector, obj)
    if mark is None:
        return None
    from launch_pytest._marked_tests import collect

    return collect(collector, name, obj, mark)  # type: ignore[arg-type]


def _mark(collector: Any, function: object) -> Optional[pytest.Mark]:
    """Return the marker of a test function, its class or its module."""
    for mark in getattr(function, 'pytestmark', ()):
        if mark.name == _MARKER:
            found: pytest.Mark = mark
            return found
    inherited: Optional[pytest.Mark] = collector.get_closest_marker(_MARKER)
    return inherited


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """
    Move tests that run after shutdown behind all other tests on the same launch.

    Parameters
    ----------
    items
        All tests of the run, reordered in place.

    """
    if _is_used():
        from launch_pytest._marked_tests import put_after_shutdown_last

        put_after_shutdown_last(items)


@pytest.hookimpl(tryfirst=True)
def pytest_pyfunc_call(pyfuncitem: pytest.Function) -> Optional[bool]:
    """
    Run a test function that has the marker.

    Parameters
    ----------
    pyfuncitem
        Any test function.

    Returns
    -------
    bool or None
        True if it has been run; None leaves it to other plugins.

    """
    if not _is_used():
        return None
    from launch_pytest._marked_tests import run_marked

    return run_marked(pyfuncitem) or None


def _is_used() -> bool:
    """Whether any test with the marker was collected."""
    return 'launch_pytest._marked_tests' in sys.modules


@pytest.fixture
def launch_service(request: pytest.FixtureRequest) -> LaunchService:
    """
    Return the LaunchService that runs the launch of the test.

    Parameters
    ----------
    request
        The request of a test for this fixture.

    """
    return _session(request).service


@pytest.fixture
def launch_context(request: pytest.FixtureRequest) -> LaunchContext:
    """
    Return the LaunchContext of the launch of the test.

    Parameters
    ----------
    request
        The request of a test for this fixture.

    """
    return _session(request).context


def _session(request: pytest.FixtureRequest) -> LaunchSession:
    mark = request.node.get_closest_marker(_MARKER)
    if mark is None:
        raise pytest.UsageError(
            f"{request.node.nodeid}: the fixture '{request.fixturename}' is for tests with "
            f'@pytest.mark.{_MARKER}(fixture=...)'
        )
    from launch_pytest._fixture import launch_fixture_of
    from launch_pytest._marked_tests import session_of

    name = launch_fixture_of(mark, request.node.nodeid).name
    request.getfixturevalue(name)
    return session_of(request.node, name)
