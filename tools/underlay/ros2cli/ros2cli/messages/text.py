# SPDX-License-Identifier: Apache-2.0
"""
Serialization of messages to YAML and comma-separated values.

What streams of messages consist of, that is, mappings, lists, numbers and single-line strings, is
written as block YAML here: as PyYAML does it, but several times as fast. All else is left to it.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from math import isfinite
import re
from typing import Any

from ros2cli.messages.plain import Shortening, to_plain
import yaml

PLAIN_TEXT = re.compile(r'[a-zA-Z_/][a-zA-Z0-9_/]{5,}')
Dumper: Any = getattr(yaml, 'CSafeDumper', yaml.SafeDumper)
UNLIMITED_WIDTH = 2**31 - 1


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
    text: str = yaml.dump(
        plain,
        Dumper=Dumper,
        allow_unicode=True,
        sort_keys=False,
        width=UNLIMITED_WIDTH,
        default_flow_style=flow_style,
    )
    return text
