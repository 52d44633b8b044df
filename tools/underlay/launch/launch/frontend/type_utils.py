# SPDX-License-Identifier: Apache-2.0
"""Types of attributes in launch files."""

from __future__ import annotations

from typing import Any, get_args, get_origin

from launch.frontend.entity import check_is_list_entity
from launch.utilities.type_utils import coerce_to_type, has_type, type_name, uniform_or_raise

__all__ = [
    'check_is_list_entity',
    'checked_value',
    'get_data_type_from_identifier',
    'value_of_text',
    'value_of_texts',
]

_TYPES: dict[str, Any] = {
    'bool': bool,
    'float': float,
    'int': int,
    'str': str,
    'list_of_bool': list[bool],
    'list_of_bools': list[bool],
    'list_of_float': list[float],
    'list_of_floats': list[float],
    'list_of_int': list[int],
    'list_of_ints': list[int],
    'list_of_str': list[str],
    'list_of_strs': list[str],
    'yaml': None,
}


def get_data_type_from_identifier(type_name: str) -> Any:
    """
    Look up a type by its name in launch files.

    Parameters
    ----------
    type_name
        The name, such as `int` or `list_of_strs`.

    Returns
    -------
    Any
        The type; None for the rules of YAML.

    Raises
    ------
    ValueError
        The name is unknown.

    """
    if type_name not in _TYPES:
        raise ValueError(f"unknown type '{type_name}': expected one of {', '.join(_TYPES)}")
    return _TYPES[type_name]


def value_of_text(text: str, data_type: Any, can_be_str: bool) -> Any:
    """
    Convert the text of an attribute to a type.

    Parameters
    ----------
    text
        The text.
    data_type
        The type, as for `Entity.get_attr`.
    can_be_str
        Whether a string with substitutions is returned as it is.

    Raises
    ------
    TypeError
        The text cannot be converted, or has substitutions that are not allowed.

    """
    if data_type is str or (not text and data_type is None):
        return text
    if '$(' in text:
        if can_be_str:
            return text
        raise TypeError(f"'{text}' must be of type {type_name(data_type)}, without substitutions")
    try:
        return coerce_to_type(text, data_type)
    except ValueError as error:
        advice = '. Give it the type str if it is meant as a string' if data_type is None else ''
        raise TypeError(f'{error}{advice}') from error


def value_of_texts(texts: list[str], data_type: Any, can_be_str: bool) -> list[Any]:
    """
    Convert the strings of a list to the type of its items.

    Parameters
    ----------
    texts
        The strings.
    data_type
        The type of the list, such as `list[int]`; for any other, YAML rules decide.
    can_be_str
        Whether a list of strings with substitutions is returned as it is.

    Raises
    ------
    TypeError
        A string cannot be converted, or has substitutions that are not allowed.
    ValueError
        YAML rules give items of different types.

    """
    item_type = get_args(data_type)[0] if get_origin(data_type) is list else None
    if can_be_str and any('$(' in text for text in texts):
        return list(texts)
    values = [value_of_text(text, item_type, can_be_str) for text in texts]
    return values if item_type is not None else uniform_or_raise(values)


def checked_value(value: Any, data_type: Any, can_be_str: bool) -> Any:
    """
    Check the type of a value that is already typed, as in YAML.

    Parameters
    ----------
    value
        The value; a string is converted as by `value_of_text`.
    data_type
        The type, as for `Entity.get_attr`.
    can_be_str
        Whether strings with substitutions are returned as they are.

    Raises
    ------
    TypeError
        The value has another type.
    ValueError
        The value is a list of different types, and no type is asked for.

    """
    if data_type is None and isinstance(value, (bool, int, float, str)):
        return value
    if data_type is None and isinstance(value, list):
        return uniform_or_raise(value)
    if isinstance(value, str):
        return value_of_text(value, data_type, can_be_str)
    if can_be_str and get_origin(data_type) is list and _has_substitutions(value):
        return value
    if (data_type is float and isinstance(value, int)) or not _has_type(value, data_type):
        what = 'nothing' if value is None else f'{value!r} of type {type(value).__name__}'
        raise TypeError(
            f'expected {type_name(data_type)}, but got {what}. {_advice(value, data_type)}'
        )
    return value


def _has_type(value: Any, data_type: Any) -> bool:
    return data_type is not None and has_type(value, data_type)


def _has_substitutions(value: Any) -> bool:
    return isinstance(value, list) and any(
        isinstance(item, str) and '$(' in item for item in value
    )


def _advice(value: Any, data_type: Any) -> str:
    if data_type is float and isinstance(value, int) and not isinstance(value, bool):
        return f'Write {float(value)} instead'
    if data_type is str and isinstance(value, (bool, int, float)):
        return f"Put it in quotes: '{str(value).lower() if isinstance(value, bool) else value}'"
    if value is None:
        return "Omit it, or write '' for an empty string"
    return 'Write a value of that type'
