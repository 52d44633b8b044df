# SPDX-License-Identifier: Apache-2.0
"""Completion of the paths of numeric fields of a message type."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import islice
from typing import Any

from robot_console.plots.field_names import name_field, names_fields
from robot_console.plots.field_types import element_type, is_message, is_number, Schema

__all__ = ['completions']

MAX_PATHS = 500
MAX_ELEMENTS = 64
MAX_DEPTH = 8


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
