# SPDX-License-Identifier: Apache-2.0
"""The values of parameters: which ones there may be, and their types."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
import os
from typing import Any

from launch.launch_context import LaunchContext
from launch.substitution import Substitution
from launch.utilities._scalars import read_value
from launch.utilities.normalize_to_list_of_substitutions_impl import (
    normalize_to_list_of_substitutions,
)
from launch.utilities.perform_substitutions_impl import perform_substitutions

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
    A text that gets its type by YAML rules when it is evaluated.

    Parameters
    ----------
    parts
        Texts and substitutions, which are joined.

    Attributes
    ----------
    parts
        The same, each as a substitution.

    """

    def __init__(self, parts: Iterable[Any]) -> None:
        self.parts = normalize_to_list_of_substitutions(parts)

    def evaluate(self, context: LaunchContext, name: str) -> Any:
        """
        Evaluate the text into the value of a parameter.

        Parameters
        ----------
        context
            What substitutions are performed with.
        name
            The parameter, for error messages.

        Raises
        ------
        TypeError
            A parameter cannot have the value.

        """
        return type_text(perform_substitutions(context, self.parts), name)


def normalize_value(value: Any, name: str) -> Any:
    """
    Normalize the value of a parameter, so that it can be evaluated at run time.

    Parameters
    ----------
    value
        A scalar, a path, a substitution, a ParameterValue, or a list.
    name
        The parameter, for error messages.

    Returns
    -------
    Any
        A plain value, what has an `evaluate` of its own, a TypedText, or a list of those.

    Raises
    ------
    TypeError
        A parameter cannot have the value.

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
        What substitutions are performed with.
    value
        What `normalize_value` has returned.
    name
        The parameter, for error messages.

    Raises
    ------
    TypeError
        A parameter cannot have the value.

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
    Convert a text into a value by YAML rules; an empty one stays a text.

    Parameters
    ----------
    text
        The text, with all substitutions performed.
    name
        The parameter, for error messages.

    Raises
    ------
    TypeError
        The text is not YAML, or a parameter cannot have the value.

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
    Return a value if a parameter can have it, with lists made uniform.

    Parameters
    ----------
    value
        Any plain value.
    name
        The parameter, for error messages.

    Raises
    ------
    TypeError
        A parameter cannot have the value.

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
    Return a list whose items have one type; integers among floats become floats.

    Parameters
    ----------
    items
        The items.
    name
        The parameter, for error messages.

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
