# SPDX-License-Identifier: Apache-2.0
"""Decorators of launch tests: several launch descriptions, and tests after shutdown."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any, TypeVar, Union
import unittest

FunctionT = TypeVar('FunctionT', bound=Callable[..., Any])
CaseT = TypeVar('CaseT', bound=type[unittest.TestCase])

_PARAMETERS = '__launch_test_parameters__'
_POST_SHUTDOWN = '__launch_test_post_shutdown__'


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
