# SPDX-License-Identifier: Apache-2.0
"""
Which numeric fields a message type has, for completion, and how list elements are named.

Messages provide names in two ways: as a list of names parallel to the others, such as `name` of a
JointState; or as a string field of each element, such as `child_frame_id` of transforms.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import islice
import re
from typing import Any

__all__ = [
    'Schema',
    'completions',
    'element_type',
    'is_message',
    'is_number',
    'name_field',
    'names_fields',
]

Schema = Callable[[str], Mapping[str, str]]
"""Returns the fields of a message type with their types, in order."""
NUMBERS = (
    {'double', 'float', 'boolean', 'octet', 'char', 'long double'}
    | {f'int{bits}' for bits in (8, 16, 32, 64)}
    | {f'uint{bits}' for bits in (8, 16, 32, 64)}
)
LIST = re.compile(r'sequence<(?P<sequence>.+?)(?:, *\d+)?>|(?P<array>.+)\[\d*\]')

NAME_FIELDS = ('name', 'child_frame_id', 'key', 'id', 'class_id')

MAX_PATHS = 500
MAX_ELEMENTS = 64
MAX_DEPTH = 8


def element_type(kind: str) -> str | None:
    """
    Return the element type of an array or sequence type.

    Parameters
    ----------
    kind
        The type of a field, for example `sequence<double>` or `double[9]`.

    Returns
    -------
    str or None
        For example `double`; None if the type is neither.

    """
    found = LIST.fullmatch(kind)
    return None if found is None else found['sequence'] or found['array']


def is_number(kind: str) -> bool:
    """
    Check whether a type is numeric, including boolean and byte types.

    Parameters
    ----------
    kind
        The type of a field.

    """
    return kind in NUMBERS


def _is_text(kind: str) -> bool:
    """
    Check whether a type is a string type; arrays of strings are not.

    Parameters
    ----------
    kind
        The type of a field.

    """
    return kind.startswith(('string', 'wstring')) and element_type(kind) is None


def is_message(kind: str) -> bool:
    """
    Check whether a type is a message type, with fields of its own.

    Parameters
    ----------
    kind
        The type of a field.

    """
    return '/' in kind and element_type(kind) is None


def names_fields(fields: Mapping[str, str]) -> list[str]:
    """
    Find the fields of a message that contain names for the elements of its other lists.

    Parameters
    ----------
    fields
        The field types of the message, by field name.

    Returns
    -------
    list of str
        Lists of strings whose name ends with `name` or `names`, such as `name` of a JointState.

    """
    return [
        name
        for name, kind in fields.items()
        if name.endswith(('name', 'names')) and _is_text(element_type(kind) or '')
    ]


def name_field(fields: Mapping[str, str]) -> str | None:
    """
    Find the field of a message that identifies it among the elements of a list.

    Parameters
    ----------
    fields
        The field types of the message, by field name.

    Returns
    -------
    str or None
        For example `child_frame_id` of a transform; None if there is no such string field.

    """
    return next((name for name in NAME_FIELDS if _is_text(fields.get(name, ''))), None)


def completions(type_name: str, schema: Schema, sample: Any = None) -> list[str]:
    """
    List the paths of all numeric fields of a message type, for a menu.

    Parameters
    ----------
    type_name
        The message type, for example `sensor_msgs/msg/JointState`.
    schema
        Returns the fields of a message type; its exceptions are propagated.
    sample
        A message that provides the lengths of lists and the names of their elements. Without one,
        each list is represented by its element 0.

    Returns
    -------
    list of str
        The parts that can follow `topic.`, such as `position[left_knee]`; at most 500 paths.

    """
    return list(islice(_of_message(type_name, schema, sample, '', (), 0), MAX_PATHS))


def _of_message(
    kind: str, schema: Schema, value: Any, before: str, outer: Sequence[str], depth: int
) -> Iterator[str]:
    if depth > MAX_DEPTH:
        return
    fields = schema(kind)
    lists = (
        [list(getattr(value, name)) for name in names_fields(fields)] if value is not None else []
    )
    for name, below in fields.items():
        inner = None if value is None else getattr(value, name)
        path = f'{before}{name}'
        own = next((names for names in lists if inner is not None and _fits(names, inner)), outer)
        yield from _of_value(below, schema, inner, path, own, depth)


def _fits(names: Sequence[str], values: Any) -> bool:
    return hasattr(values, '__len__') and bool(names) and len(names) == len(values)


def _of_value(
    kind: str, schema: Schema, value: Any, path: str, names: Sequence[str], depth: int
) -> Iterator[str]:
    if is_number(kind):
        yield path
    elif is_message(kind):
        yield from _of_message(kind, schema, value, f'{path}.', names, depth + 1)
    elif (element := element_type(kind)) is not None and _has_numbers(element):
        for key, inner in _elements(element, schema, value, names):
            yield from _of_value(element, schema, inner, f'{path}[{key}]', names, depth + 1)


def _has_numbers(kind: str) -> bool:
    return is_number(kind) or is_message(kind)


def _elements(
    kind: str, schema: Schema, value: Any, names: Sequence[str]
) -> Iterator[tuple[str, Any]]:
    """Yield the elements of a list with their names or indices."""
    if value is None or len(value) == 0:
        if value is None:
            yield '0', None
        return
    fields: Mapping[str, str] = schema(kind) if is_message(kind) else {}
    own = name_field(fields)
    for place, inner in enumerate(islice(value, MAX_ELEMENTS)):
        if own is not None and getattr(inner, own):
            yield getattr(inner, own), inner
        elif _fits(names, value):
            yield names[place], inner
        else:
            yield str(place), inner
