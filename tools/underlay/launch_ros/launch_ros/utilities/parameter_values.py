# SPDX-License-Identifier: Apache-2.0
"""Validate, convert and evaluate parameter values."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
import os
from typing import Any

from launch.launch_context import LaunchContext
from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch.utilities.type_utils import read_value

_SCALARS = (bool, int, float, str, bytes)
_ALLOWED = (
    'bytes, bool, int, float, str, Sequence[bool], Sequence[int], Sequence[float], Sequence[str]'
)
_ADVICE = (
    'If the parameter is meant to be a string, try wrapping it in '
    'launch_ros.parameter_descriptions.ParameterValue(value, value_type=str)'
)


class TypedText:
    """
    Text that is typed by YAML rules when it is evaluated.

    Parameters
    ----------
    parts
        Strings and substitutions, which are concatenated.

    Attributes
    ----------
    parts
        The parts, each as a substitution.

    """

    def __init__(self, parts: Iterable[Any]) -> None:
        self.parts = normalize_to_list_of_substitutions(parts)

    def evaluate(self, context: LaunchContext, name: str) -> Any:
        """
        Evaluate the text to a parameter value.

        Parameters
        ----------
        context
            The launch context used to perform substitutions.
        name
            The parameter name, for error messages.

        Raises
        ------
        TypeError
            The value is not a valid parameter value.

        """
        return type_text(perform_substitutions(context, self.parts), name)


def normalize_value(value: Any, name: str) -> Any:
    """
    Normalize a parameter value, so that it can be evaluated at run time.

    Parameters
    ----------
    value
        A scalar, a path, a substitution, a ParameterValue, or a list.
    name
        The parameter name, for error messages.

    Returns
    -------
    Any
        A plain value, an object with an `evaluate` method, a TypedText, or a list of those.

    Raises
    ------
    TypeError
        The value is not a valid parameter value.

    """
    if isinstance(value, Substitution):
        return TypedText([value])
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, _SCALARS) or hasattr(value, 'evaluate'):
        return value
    if isinstance(value, Iterable) and not isinstance(value, Mapping):
        return _normalize_list(list(value), name)
    raise TypeError(
        f"Unexpected type for parameter value {value!r} of the parameter '{name}'. Allowed value "
        f'types are {_ALLOWED}'
    )


def _normalize_list(items: list[Any], name: str) -> Any:
    if any(isinstance(item, Substitution) for item in items):
        return TypedText(items)
    if items and all(isinstance(item, (list, tuple)) for item in items):
        return [TypedText(item) for item in items]
    return uniform(items, name)


def evaluate_value(context: LaunchContext, value: Any, name: str) -> Any:
    """
    Evaluate a normalized value.

    Parameters
    ----------
    context
        The launch context used to perform substitutions.
    value
        The result of `normalize_value`.
    name
        The parameter name, for error messages.

    Raises
    ------
    TypeError
        The value is not a valid parameter value.

    """
    if isinstance(value, TypedText):
        return value.evaluate(context, name)
    if isinstance(value, list) and any(isinstance(item, TypedText) for item in value):
        return uniform([item.evaluate(context, name) for item in value], name)
    if hasattr(value, 'evaluate'):
        return checked(value.evaluate(context), name)
    return value


def type_text(text: str, name: str) -> Any:
    """
    Convert a text to a value by YAML rules; an empty text stays a string.

    Parameters
    ----------
    text
        The text, with all substitutions performed.
    name
        The parameter name, for error messages.

    Raises
    ------
    TypeError
        The text is not valid YAML, or the value is not a valid parameter value.

    """
    if not text:
        return text
    try:
        value = read_value(text)
    except ValueError as error:
        raise TypeError(
            f'Unable to parse the value of parameter {name} as yaml. {_ADVICE}'
        ) from error
    return checked(value, name)


def checked(value: Any, name: str) -> Any:
    """
    Validate a parameter value; the items of lists are converted to one type.

    Parameters
    ----------
    value
        Any plain value.
    name
        The parameter name, for error messages.

    Raises
    ------
    TypeError
        The value is not a valid parameter value.

    """
    if isinstance(value, (list, tuple)):
        return uniform(list(value), name)
    if isinstance(value, _SCALARS):
        return value
    raise TypeError(
        f'Allowed value types are {_ALLOWED}. Got {type(value)} for "{name}". {_ADVICE}'
    )


def uniform(items: list[Any], name: str) -> list[Any]:
    """
    Return a list with items of one type; integers among floats become floats.

    Parameters
    ----------
    items
        The items.
    name
        The parameter name, for error messages.

    Raises
    ------
    TypeError
        The list is empty, or its items are not all bool, int, float or str.

    """
    kinds = {type(item) for item in items}
    if kinds == {int, float}:
        return [float(item) for item in items]
    if len(kinds) == 1 and kinds <= {bool, int, float, str}:
        return items
    raise TypeError(
        'Expected a non-empty sequence, with items of uniform type. '
        f'Allowed sequence item types are bool, int, float, str. Got inconsistent input for '
        f'"{name}": {items!r}'
    )
