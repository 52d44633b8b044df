# SPDX-License-Identifier: Apache-2.0
"""Decorator for launch fixtures."""

from __future__ import annotations

from collections.abc import Callable, Iterator
import functools
import inspect
from typing import Any, NamedTuple, Optional

from launch import LaunchDescription
from launch_pytest._session import LaunchSession, SESSIONS
import pytest

_ATTRIBUTE = '_launch_pytest_fixture'


class LaunchFixture(NamedTuple):
    """Metadata of a launch fixture."""

    name: str
    scope: str


def fixture(
    decorated: Optional[Callable[..., Any]] = None,
    *,
    scope: str = 'function',
    auto_shutdown: bool = True,
    **kwargs: Any,
) -> Any:
    """
    Create a launch fixture from a function that returns a launch description.

    The function may also return or yield a sequence that starts with a launch description.

    Parameters
    ----------
    decorated
        The function, if used as a decorator without arguments.
    scope
        The lifetime of the launch, as for pytest.fixture.
    auto_shutdown
        Whether the launch continues until the tests are done and is then shut down; otherwise it
        ends with its processes.
    **kwargs
        The other arguments of pytest.fixture.

    Returns
    -------
    Any
        The fixture, or the decorator that creates it.

    """

    def decorate(function: Callable[..., Any]) -> Any:
        launching = _launching(function, auto_shutdown=auto_shutdown)
        result = pytest.fixture(scope=scope, **kwargs)(launching)  # type: ignore[call-overload]
        name = kwargs.get('name') or function.__name__
        setattr(result, _ATTRIBUTE, LaunchFixture(name, scope))
        return result

    return decorate if decorated is None else decorate(decorated)


def launch_fixture_of(mark: pytest.Mark, nodeid: str) -> LaunchFixture:
    """
    Return the launch fixture that the marker of a test refers to.

    Parameters
    ----------
    mark
        The marker `launch`.
    nodeid
        The test, for error messages.

    Raises
    ------
    pytest.UsageError
        The marker does not refer to a launch fixture.

    """
    found = getattr(mark.kwargs.get('fixture'), _ATTRIBUTE, None)
    if not isinstance(found, LaunchFixture):
        raise pytest.UsageError(
            f"{nodeid}: pytest.mark.launch needs 'fixture=...', with a function that is decorated "
            f'by launch_pytest.fixture, but got {mark.kwargs.get("fixture")!r}'
        )
    return found


def _launching(function: Callable[..., Any], *, auto_shutdown: bool) -> Callable[..., Any]:
    """Wrap a function into the generator function of the fixture."""
    signature = inspect.signature(function)
    takes_request = 'request' in signature.parameters

    def launching(*args: Any, request: pytest.FixtureRequest, **kwargs: Any) -> Iterator[Any]:
        if takes_request:
            kwargs['request'] = request
        produced = function(*args, **kwargs)
        value = next(produced) if inspect.isgenerator(produced) else produced
        try:
            session = LaunchSession(_description(value, function), auto_shutdown=auto_shutdown)
            name = request.fixturename or function.__name__
            request.node.stash.setdefault(SESSIONS, {})[name] = session
            try:
                session.start()
                yield value
            finally:
                session.close()
        finally:
            if inspect.isgenerator(produced):
                next(produced, None)

    functools.update_wrapper(launching, function)
    del launching.__wrapped__  # type: ignore[attr-defined]
    if not takes_request:
        request = inspect.Parameter('request', inspect.Parameter.KEYWORD_ONLY)
        signature = signature.replace(parameters=[*signature.parameters.values(), request])
    launching.__signature__ = signature  # type: ignore[attr-defined]
    return launching


def _description(value: Any, function: Callable[..., Any]) -> LaunchDescription:
    """Extract the launch description from the value of a fixture."""
    first = value[0] if isinstance(value, (list, tuple)) and value else value
    if not isinstance(first, LaunchDescription):
        raise TypeError(
            f'{function.__qualname__}() must return a LaunchDescription, or a sequence that '
            f'begins with one, but it returned {value!r}'
        )
    return first
