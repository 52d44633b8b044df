# SPDX-License-Identifier: Apache-2.0
"""Convert performed substitutions to the requested types; scalars follow the rules of YAML 1.1."""

from __future__ import annotations

from collections.abc import Iterable
import os
import re
from typing import Any, get_args, get_origin, Optional, TYPE_CHECKING

from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

_SCALARS = (bool, int, float, str)
_TRUE = frozenset(('true', 'True', 'TRUE', 'yes', 'Yes', 'YES', 'on', 'On', 'ON'))
_FALSE = frozenset(('false', 'False', 'FALSE', 'no', 'No', 'NO', 'off', 'Off', 'OFF'))
_NOTHING = frozenset(('null', 'Null', 'NULL'))
_DECIMAL = re.compile(r'[-+]?(?:0|[1-9][0-9]*)')
_POINT = re.compile(r'[-+]?[0-9]+\.[0-9]*(?:[eE][-+][0-9]+)?')
EXPONENT = re.compile(r'[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)[eE][-+]?[0-9]+')
_PLAIN_WORD = re.compile(r'[A-Za-z/_][A-Za-z0-9/_.-]*')


def is_substitution(value: Any) -> bool:
    """
    Whether a value is a substitution, or an iterable that contains one.

    Parameters
    ----------
    value
        The value; a string is neither.

    """
    if isinstance(value, Substitution):
        return True
    if isinstance(value, Iterable) and not isinstance(value, (str, bytes)):
        return any(isinstance(item, Substitution) for item in value)
    return False


def normalize_typed_substitution(value: Any, data_type: Optional[Any]) -> Any:
    """
    Normalise a typed value, or substitutions that resolve to one.

    Parameters
    ----------
    value
        The value, a string, substitutions, or a list of lists with substitutions.
    data_type
        The type, such as `bool` or `list[int]`; None for any.

    Returns
    -------
    Any
        The value as it is; a list of substitutions for a string; a list of tuples of them for a
        list.

    Raises
    ------
    TypeError
        The value neither has the type nor resolves to it.

    """
    if isinstance(value, (str, os.PathLike)) or is_substitution(value):
        return normalize_to_list_of_substitutions(value)
    if _has_texts_as_items(value):
        return [tuple(normalize_to_list_of_substitutions(item)) for item in value]
    if data_type is not None and not has_type(value, data_type):
        raise TypeError(f"value='{value!r}' is not of type '{type_name(data_type)}'")
    return value


def perform_typed_substitution(
    context: LaunchContext,
    value: Any,
    data_type: Optional[Any],
) -> Any:
    """
    Perform a value from `normalize_typed_substitution` and convert it to a type.

    Parameters
    ----------
    context
        The launch context.
    value
        The value.
    data_type
        The type, such as `bool` or `list[int]`; without one, YAML rules decide.

    Returns
    -------
    Any
        The converted value; a value that is not a substitution is returned unchanged.

    Raises
    ------
    ValueError
        The text cannot be converted.

    """
    if is_substitution(value):
        value = perform_substitutions(context, normalize_to_list_of_substitutions(value))
    elif _has_texts_as_items(value):
        item_type = get_args(data_type)[0] if get_origin(data_type) is list else None
        items = [coerce_to_type(perform_substitutions(context, item), item_type) for item in value]
        return items if data_type is not None else uniform_or_raise(items)
    if isinstance(value, str):
        return coerce_to_type(value, data_type)
    return value


def _has_texts_as_items(value: Any) -> bool:
    """Check whether a value is a list whose items are lists of substitutions."""
    return isinstance(value, list) and any(
        isinstance(item, (list, tuple)) and is_substitution(item) for item in value
    )


def coerce_to_type(value: str, data_type: Optional[Any] = None) -> Any:
    """
    Convert a string to a type.

    Parameters
    ----------
    value
        The text.
    data_type
        bool, int, float, str or a list of one of them; without a type, YAML rules decide.

    Raises
    ------
    ValueError
        The text cannot be converted, or there is no such type.

    """
    if data_type is None:
        return _coerce_by_yaml(value)
    if data_type is bool:
        return read_boolean(value)
    if data_type in (int, float, str):
        return data_type(value)
    if get_origin(data_type) is list:
        return _coerce_to_list(value, get_args(data_type)[0])
    raise ValueError(f"cannot convert '{value}' to the type '{data_type}'")


def _coerce_by_yaml(text: str) -> Any:
    value = read_value(text)
    if isinstance(value, list):
        return uniform_or_raise(value)
    if not isinstance(value, _SCALARS):
        raise ValueError(
            f"cannot read '{text}' as one of str, int, float, bool or a list of one of them"
        )
    return value


def uniform_or_raise(items: list[Any]) -> list[Any]:
    """
    Check that the items of a list all have the same scalar type.

    Parameters
    ----------
    items
        The list, which is returned as it is.

    Raises
    ------
    ValueError
        The types of the items differ, or one is neither str, int, float nor bool.

    """
    kinds = {type(item) for item in items}
    if len(kinds) > 1 or not kinds.issubset(_SCALARS):
        raise ValueError(
            f'The result is a non-uniform list: {items!r}, but all items must be str, int, float '
            'or bool'
        )
    return items


def _coerce_to_list(text: str, item_type: Any) -> list[Any]:
    value = read_value(text)
    if not isinstance(value, list) or not all(has_type(item, item_type) for item in value):
        raise ValueError(f"cannot read '{text}' as a list of {type_name(item_type)}")
    return [item_type(item) for item in value]


def has_type(value: Any, data_type: Any) -> bool:
    """
    Whether a value has a type; integers are accepted as floats.

    Parameters
    ----------
    value
        The value.
    data_type
        bool, int, float, str or a list of one of them.

    """
    if get_origin(data_type) is list:
        return isinstance(value, (list, tuple)) and all(
            has_type(item, get_args(data_type)[0]) for item in value
        )
    if isinstance(value, bool):
        return data_type is bool
    return isinstance(value, (int, float) if data_type is float else data_type)


def type_name(data_type: Any) -> str:
    """
    Return a human-readable name of a type.

    Parameters
    ----------
    data_type
        The type; None for any type that launch files support.

    """
    if data_type is None:
        return 'str, int, float, bool or list of one of them'
    return getattr(data_type, '__name__', str(data_type))


def read_yaml(text: str) -> Any:
    """
    Parse a YAML 1.1 document; the common scalars need no YAML parser.

    Parameters
    ----------
    text
        The document.

    Returns
    -------
    Any
        The parsed value: a scalar, a list, a dictionary or None.

    Raises
    ------
    ValueError
        The document is not valid YAML.

    """
    if text in _TRUE:
        return True
    if text in _FALSE:
        return False
    if _DECIMAL.fullmatch(text):
        return int(text)
    if _POINT.fullmatch(text):
        return float(text)
    if _PLAIN_WORD.fullmatch(text) and text not in _NOTHING:
        return text
    import yaml

    try:
        return yaml.safe_load(text)
    except yaml.YAMLError as error:
        raise ValueError(f"'{text}' is not YAML: {error}") from error


def read_value(text: str) -> Any:
    """
    Parse a YAML document, but read `1e3` as a number, as YAML 1.2 and ROS do.

    Parameters
    ----------
    text
        The document.

    Returns
    -------
    Any
        As for `read_yaml`.

    Raises
    ------
    ValueError
        The document is not valid YAML.

    """
    return float(text) if EXPONENT.fullmatch(text) else read_yaml(text)


def read_boolean(text: str) -> bool:
    """
    Parse a boolean: true, false, yes, no, on, off, 1 or 0.

    Parameters
    ----------
    text
        The word, with any space around it; true may be True or TRUE, and the others likewise.

    Raises
    ------
    ValueError
        It is none of these words.

    """
    word = text.strip()
    if word in _TRUE or word == '1':
        return True
    if word in _FALSE or word == '0':
        return False
    raise ValueError(
        f"cannot read '{text}' as a boolean: expected true, false, yes, no, on, off, 1 or 0"
    )
