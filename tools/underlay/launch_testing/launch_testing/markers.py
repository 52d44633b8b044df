# SPDX-License-Identifier: Apache-2.0
"""Decorators of launch tests: markers, sets of arguments, and tests after shutdown."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
import functools
import time
from typing import Any, Optional, TypeVar, Union
import unittest

FunctionT = TypeVar('FunctionT', bound=Callable[..., Any])
CaseT = TypeVar('CaseT', bound=type[unittest.TestCase])

__all__ = [
    'is_kept_alive',
    'is_post_shutdown_test',
    'keep_alive',
    'parameter_sets',
    'parametrize',
    'post_shutdown_test',
    'retry_on_failure',
]

_KEEP_ALIVE = '__launch_test_keep_alive__'
_PARAMETERS = '__launch_test_parameters__'
_POST_SHUTDOWN = '__launch_test_post_shutdown__'


def keep_alive(function: FunctionT) -> FunctionT:
    """
    Mark a `generate_test_description` whose launch continues after its processes have ended.

    Parameters
    ----------
    function
        The function, which is returned unchanged.

    """
    setattr(function, _KEEP_ALIVE, True)
    return function


def is_kept_alive(function: Callable[..., Any]) -> bool:
    """
    Whether the launch of a function continues after its processes have ended.

    Parameters
    ----------
    function
        The function `generate_test_description`.

    """
    return bool(getattr(function, _KEEP_ALIVE, False))


def retry_on_failure(
    *,
    times: int,
    delay: Optional[float] = None,
) -> Callable[[FunctionT], FunctionT]:
    """
    Return a decorator that retries a test after an AssertionError.

    Parameters
    ----------
    times
        The maximum number of attempts.
    delay
        The delay between two attempts, in s; None for no delay.

    Raises
    ------
    ValueError
        The number of attempts is less than 1.

    """
    if times < 1:
        raise ValueError(f'a test must be tried at least once, but times={times}')

    def decorate(test: FunctionT) -> FunctionT:
        @functools.wraps(test)
        def attempt(*args: Any, **kwargs: Any) -> Any:
            for _ in range(times - 1):
                try:
                    return test(*args, **kwargs)
                except AssertionError:
                    time.sleep(delay or 0.0)
            return test(*args, **kwargs)

        return attempt  # type: ignore[return-value]

    return decorate


def parametrize(
    argnames: Union[str, Sequence[str]],
    argvalues: Iterable[Any],
) -> Callable[[FunctionT], FunctionT]:
    """
    Return a decorator that parametrizes a function with several sets of arguments.

    For use on `generate_test_description`; accepts arguments like the one of pytest. With several
    decorators, the function is called with each combination.

    Parameters
    ----------
    argnames
        The names of the arguments, as a list or separated by commas.
    argvalues
        One value for each call, or a sequence of values if there are several names.

    Raises
    ------
    ValueError
        The number of values does not match the number of names.

    """
    names = _split(argnames)
    sets = [dict(zip(names, _checked(names, values))) for values in argvalues]

    def decorate(function: FunctionT) -> FunctionT:
        before = parameter_sets(function)
        setattr(function, _PARAMETERS, [{**old, **new} for new in sets for old in before])
        return function

    return decorate


def parameter_sets(function: Callable[..., Any]) -> list[dict[str, Any]]:
    """
    Return the keyword arguments for each call of a possibly parametrized function.

    Parameters
    ----------
    function
        The function; without parametrization there is one call, without arguments.

    """
    sets: list[dict[str, Any]] = getattr(function, _PARAMETERS, [{}])
    return sets


def _split(argnames: Union[str, Sequence[str]]) -> list[str]:
    if isinstance(argnames, str):
        return [name.strip() for name in argnames.split(',') if name.strip()]
    return list(argnames)


def _checked(names: list[str], values: Any) -> Sequence[Any]:
    """Validate that there is one value for each name."""
    if len(names) == 1:
        return [values]
    if len(values) != len(names):
        raise ValueError(
            f'parametrize got the {len(names)} names {", ".join(names)}, but the '
            f'{len(values)} values {values!r}: there must be one value for each name'
        )
    result: Sequence[Any] = values
    return result


def post_shutdown_test() -> Callable[[CaseT], CaseT]:
    """Return a TestCase decorator; its tests run after all processes have ended."""

    def decorate(case: CaseT) -> CaseT:
        if not (isinstance(case, type) and issubclass(case, unittest.TestCase)):
            raise TypeError(
                f'post_shutdown_test() decorates subclasses of unittest.TestCase, but not {case!r}'
            )
        setattr(case, _POST_SHUTDOWN, True)
        return case

    return decorate


def is_post_shutdown_test(case: unittest.TestCase) -> bool:
    """
    Whether a test runs after the shutdown of the launch.

    Parameters
    ----------
    case
        The test.

    """
    return bool(getattr(case, _POST_SHUTDOWN, False))
