# SPDX-License-Identifier: Apache-2.0
"""Check the types of arguments of actions; errors name the keyword."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
import os
from typing import Any, NoReturn, Optional

from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions
from launch.utilities.type_utils import normalize_typed_substitution


def text_like(keyword: str, value: Any) -> list[Substitution]:
    """
    Normalise an argument to a list of substitutions.

    Parameters
    ----------
    keyword
        The name of the argument, for the error.
    value
        A string, a path, a substitution or an iterable of them.

    Raises
    ------
    TypeError
        The value is none of these.

    """
    try:
        return normalize_to_list_of_substitutions(value)
    except TypeError as error:
        _refuse(keyword, 'a string, a substitution or a list of them', value, error)


def optional_text_like(keyword: str, value: Any) -> Optional[list[Substitution]]:
    """
    Normalise an optional argument to a list of substitutions, or None.

    Parameters
    ----------
    keyword, value
        As for `text_like`; None is returned as it is.

    Raises
    ------
    TypeError
        The value is neither None nor anything that `text_like` accepts.

    """
    return None if value is None else text_like(keyword, value)


def list_like(keyword: str, value: Any, items: str) -> list[Any]:
    """
    Convert an iterable argument to a list.

    Parameters
    ----------
    keyword
        The name of the argument, for the error.
    value
        Any iterable except a string, a path, a substitution or a mapping.
    items
        The kind of items, in the plural, for the error.

    Raises
    ------
    TypeError
        The value is not such an iterable; the items are not checked.

    """
    is_single = isinstance(value, (str, bytes, os.PathLike, Substitution, Mapping))
    if is_single or not isinstance(value, Iterable):
        _refuse(keyword, f'a list of {items}', value)
    return list(value)


def mapping_like(keyword: str, value: Any) -> Mapping[Any, Any]:
    """
    Convert an argument to a mapping.

    Parameters
    ----------
    keyword
        The name of the argument, for the error.
    value
        A mapping, which is returned as it is, or pairs of a key and a value.

    Raises
    ------
    TypeError
        The value is neither.

    """
    if isinstance(value, Mapping):
        return value
    try:
        return dict(value)
    except (TypeError, ValueError):
        _refuse(keyword, 'a dictionary', value)


def of_type(keyword: str, value: Any, types: tuple[type, ...], expected: str) -> None:
    """
    Check the type of an argument.

    Parameters
    ----------
    keyword, value
        The name of the argument, for the error, and its value.
    types
        The classes of which the value must be an instance.
    expected
        A description of these classes, for the error.

    Raises
    ------
    TypeError
        The value has another type.

    """
    if not isinstance(value, types):
        _refuse(keyword, expected, value)


def typed(keyword: str, value: Any, kind: Any, expected: str) -> Any:
    """
    Normalise an argument that has a type, or substitutions that resolve to it.

    Parameters
    ----------
    keyword, value
        The name of the argument, for the error, and its value.
    kind
        The type of the performed argument, such as `bool`.
    expected
        A description of valid values, for the error.

    Returns
    -------
    Any
        A value of the type, unchanged; a string or substitutions as a list of substitutions.

    Raises
    ------
    TypeError
        The value neither has the type nor can be a substitution for it.

    """
    try:
        return normalize_typed_substitution(value, kind)
    except TypeError:
        _refuse(keyword, expected, value)


def seconds_like(keyword: str, value: Any) -> list[Substitution]:
    """
    Normalise a timeout to substitutions.

    Parameters
    ----------
    keyword
        The name of the argument, for the error.
    value
        A number of seconds, or anything that `text_like` accepts.

    Raises
    ------
    TypeError
        The value is neither.

    """
    return text_like(keyword, str(value) if isinstance(value, (int, float)) else value)


def output_like(value: Any) -> Any:
    """
    Normalise the option `output` of a process.

    Parameters
    ----------
    value
        A dictionary by stream, which is returned as it is, or anything that `text_like` accepts.

    Returns
    -------
    dict or list of Substitution
        The dictionary, or the substitutions of the name of a preset.

    Raises
    ------
    TypeError
        The value is neither.

    """
    return value if isinstance(value, dict) else text_like('output', value)


def _refuse(
    keyword: str,
    expected: str,
    value: Any,
    error: Optional[TypeError] = None,
) -> NoReturn:
    """Raise a TypeError about an argument, with the underlying error if there is one."""
    found = f"{value!r} of type '{type(value).__name__}'"
    inside = f' ({error})' if error is not None else ''
    raise TypeError(f"the argument '{keyword}' must be {expected}, but it is {found}{inside}")
