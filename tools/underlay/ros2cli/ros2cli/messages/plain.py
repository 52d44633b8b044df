# SPDX-License-Identifier: Apache-2.0
"""Messages as plain Python values: mappings, lists, numbers and strings."""

from __future__ import annotations

from typing import Any, NamedTuple

IDL_NAMES = {'double': 'float64', 'float': 'float32', 'boolean': 'bool', 'octet': 'byte'}


class Shortening(NamedTuple):
    """Maximum length of strings and arrays, and whether they are shown at all."""

    length: int | None = None
    hide_arrays: bool = False
    hide_strings: bool = False


def to_plain(value: Any, shortening: Shortening = Shortening(), field_type: str = '') -> Any:
    """
    Convert a message, or the value of a field, to plain Python values.

    Parameters
    ----------
    value
        The message or value.
    shortening
        Maximum lengths of strings and arrays.
    field_type
        The type of the field, as rosidl names it, such as `sequence<double>`.

    Returns
    -------
    Any
        Mappings in the order of the fields, lists, numbers and strings.

    """
    if hasattr(value, 'get_fields_and_field_types'):
        return {
            name: to_plain(getattr(value, name), shortening, field_type)
            for name, field_type in value.get_fields_and_field_types().items()
        }
    if isinstance(value, dict):
        return {name: to_plain(value[name], shortening) for name in sorted(value)}
    if isinstance(value, (str, bytes)):
        return _text(value, shortening)
    if hasattr(value, '__len__'):
        return _array(value, shortening, field_type)
    return value


def _text(value: str | bytes, shortening: Shortening) -> str:
    text = value if isinstance(value, str) else value.decode('latin-1')
    if shortening.hide_strings:
        return f'<string length: <{len(text)}>>'
    if shortening.length is not None and len(text) > shortening.length:
        return f'{text[: shortening.length]}...'
    return text


def _array(value: Any, shortening: Shortening, field_type: str) -> Any:
    if shortening.hide_arrays:
        return _array_summary(len(value), field_type)
    cut = shortening.length is not None and len(value) > shortening.length
    head = value[: shortening.length] if cut else value
    items = head.tolist() if hasattr(head, 'tolist') else head
    inner = element_type(field_type)
    plain = [to_plain(item, shortening, inner) for item in items]
    return [*plain, '...'] if cut else plain


def _array_summary(length: int, field_type: str) -> str:
    element = element_type(field_type)
    element = IDL_NAMES.get(element, element)
    if field_type.startswith('sequence'):
        return f'<sequence type: {element}, length: {length}>'
    return f'<array type: {element}[{length}]>'


def element_type(field_type: str) -> str:
    """
    Return the type of the elements of an array or sequence, such as `double`.

    Parameters
    ----------
    field_type
        The type of the field, such as `sequence<double>`, `sequence<double, 3>` or `double[3]`.

    """
    if field_type.startswith('sequence<'):
        inner = field_type.removeprefix('sequence<').removesuffix('>')
        return inner.rpartition(', ')[0] if inner.rpartition(', ')[2].isdigit() else inner
    return field_type.partition('[')[0]
