# SPDX-License-Identifier: Apache-2.0
"""Run the tests of a file once for each of several launch descriptions."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any, TypeVar, Union

FunctionT = TypeVar('FunctionT', bound=Callable[..., Any])

_ATTRIBUTE = '__launch_test_parameters__'


def parametrize(
    argnames: Union[str, Sequence[str]],
    argvalues: Iterable[Any],
) -> Callable[[FunctionT], FunctionT]:
    """
    Return a decorator that has a function called with each of some values.

    It is meant for `generate_test_description`, and takes its arguments as that of pytest does:
    one name with a value each, or several names with as many values each.
    """
    names = _split(argnames)
    sets = [dict(zip(names, _checked(names, values))) for values in argvalues]

    def decorate(function: FunctionT) -> FunctionT:
        before = parameter_sets(function)
        setattr(function, _ATTRIBUTE, [{**old, **new} for new in sets for old in before])
        return function

    return decorate


def parameter_sets(function: Callable[..., Any]) -> list[dict[str, Any]]:
    """Return the arguments of each call of a function that may be parametrized."""
    sets: list[dict[str, Any]] = getattr(function, _ATTRIBUTE, [{}])
    return sets


def _split(argnames: Union[str, Sequence[str]]) -> list[str]:
    if isinstance(argnames, str):
        return [name.strip() for name in argnames.split(',') if name.strip()]
    return list(argnames)


def _checked(names: list[str], values: Any) -> Sequence[Any]:
    """Return one value for each name."""
    if len(names) == 1:
        return [values]
    if len(values) != len(names):
        raise ValueError(
            f'parametrize got the {len(names)} names {", ".join(names)}, but the '
            f'{len(values)} values {values!r}: there must be one value for each name'
        )
    result: Sequence[Any] = values
    return result
