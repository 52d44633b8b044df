# SPDX-License-Identifier: Apache-2.0
"""
Messages as plain Python values, and these as YAML or comma-separated values.

What streams of messages consist of, that is, mappings, lists, numbers and single-line strings, is
written as block YAML here: as PyYAML does it, but several times as fast. All else is left to
PyYAML, which is imported only then.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from math import isfinite
import re
from typing import Any, NamedTuple

PLAIN_TEXT = re.compile(r'[a-zA-Z_/][a-zA-Z0-9_/]{5,}')
UNLIMITED_WIDTH = 2**31 - 1
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
        return _plain_text(value, shortening)
    if hasattr(value, '__len__'):
        return _array(value, shortening, field_type)
    return value


def _plain_text(value: str | bytes, shortening: Shortening) -> str:
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


def to_yaml(value: Any, shortening: Shortening = Shortening(), *, flow_style: bool = False) -> str:
    """
    Serialize a message to YAML.

    Parameters
    ----------
    value
        The message.
    shortening
        Maximum lengths of strings and arrays.
    flow_style
        Whether to write it on one line instead of one field per line.

    """
    return plain_to_yaml(to_plain(value, shortening), flow_style=flow_style)


def plain_to_yaml(plain: Any, *, flow_style: bool = False) -> str:
    """
    Serialize plain values to YAML, without PyYAML where that is possible.

    Parameters
    ----------
    plain
        Mappings, lists, numbers and strings.
    flow_style
        Whether to write it on one line.

    """
    if flow_style:
        return dump(plain, flow_style=True)
    try:
        return to_block_yaml(plain)
    except NeedsPyYaml:
        return dump(plain, flow_style=False)


def to_csv(value: Any, shortening: Shortening = Shortening()) -> str:
    """
    Serialize the values of all fields of a message, depth first, with commas between them.

    Parameters
    ----------
    value
        The message.
    shortening
        Maximum lengths of strings and arrays.

    """
    return plain_to_csv(to_plain(value, shortening))


def plain_to_csv(plain: Any) -> str:
    """
    Serialize plain values, depth first, with commas between them.

    Parameters
    ----------
    plain
        Mappings, lists, numbers and strings; nothing is quoted.

    """
    return ','.join(str(leaf) for leaf in _leaves(plain))


def _leaves(plain: Any) -> Iterator[Any]:
    if isinstance(plain, dict):
        plain = list(plain.values())
    if not isinstance(plain, list):
        yield plain
        return
    for item in plain:
        yield from _leaves(item)


class NeedsPyYaml(Exception):
    """A value is of a kind that only PyYAML can serialize."""


def to_block_yaml(plain: Any) -> str:
    """
    Serialize a mapping or list to block YAML.

    Parameters
    ----------
    plain
        Mappings, lists, numbers and strings.

    Returns
    -------
    str
        The lines, each with its newline.

    Raises
    ------
    NeedsPyYaml
        It is neither, is empty, or has a value that only PyYAML can serialize.

    """
    if isinstance(plain, (dict, list)) and plain:
        return '\n'.join(_lines(plain, '')) + '\n'
    raise NeedsPyYaml


def _lines(plain: Any, indent: str) -> Iterator[str]:
    if isinstance(plain, dict):
        yield from _mapping_lines(plain, indent)
        return
    for item in plain:
        if isinstance(item, (dict, list)) and item:
            first, *rest = _lines(item, f'{indent}  ')
            yield f'{indent}- {first[len(indent) + 2 :]}'
            yield from rest
        else:
            yield f'{indent}- {_scalar(item)}'


def _mapping_lines(plain: dict[str, Any], indent: str) -> Iterator[str]:
    for name, value in plain.items():
        if isinstance(value, dict) and value:
            yield f'{indent}{_text(name)}:'
            yield from _lines(value, f'{indent}  ')
        elif isinstance(value, list) and value:
            yield f'{indent}{_text(name)}:'
            yield from _lines(value, indent)
        else:
            yield f'{indent}{_text(name)}: {_scalar(value)}'


def _scalar(value: Any) -> str:
    kind = type(value)
    if kind is float:
        return _float(value)
    if kind is str:
        return _text(value)
    if kind is int:
        return str(value)
    if kind is bool:
        return 'true' if value else 'false'
    if value in ([], {}):
        return str(value)
    raise NeedsPyYaml


def _float(value: float) -> str:
    text = repr(value)
    if 'e' in text and '.' not in text:
        return text.replace('e', '.0e', 1)
    if not isfinite(value):
        return '.nan' if value != value else f'{text[:-3]}.inf'
    return text


@lru_cache(maxsize=1000)
def _text(text: str) -> str:
    """Quote a string as YAML requires; PyYAML decides about unusual ones."""
    if PLAIN_TEXT.fullmatch(text):
        return text
    first, *rest = dump(text, flow_style=False).splitlines()
    if rest not in ([], ['...']):
        raise NeedsPyYaml
    return first


def dump(plain: Any, *, flow_style: bool) -> str:
    """
    Serialize a plain value with PyYAML, without wrapping lines or escaping letters.

    Parameters
    ----------
    plain
        Mappings, lists, numbers and strings.
    flow_style
        Whether to write it on one line, with braces and brackets.

    """
    import yaml

    text: str = yaml.dump(
        plain,
        Dumper=getattr(yaml, 'CSafeDumper', yaml.SafeDumper),
        allow_unicode=True,
        sort_keys=False,
        width=UNLIMITED_WIDTH,
        default_flow_style=flow_style,
    )
    return text
