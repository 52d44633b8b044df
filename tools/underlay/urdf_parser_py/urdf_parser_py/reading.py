# SPDX-License-Identifier: Apache-2.0
"""How attributes of XML become values, and values attributes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any
from xml.etree import ElementTree

__all__ = ['Element', 'add', 'number', 'numbers', 'text']

Element = ElementTree.Element


def text(element: Any, name: str, default: str | None = None) -> str:
    """
    Read an attribute.

    Parameters
    ----------
    element
        The element.
    name
        The name of the attribute.
    default
        What counts without the attribute; None if it must be there.

    Raises
    ------
    ValueError
        The attribute is missing.

    """
    found = element.get(name, default)
    if found is None:
        raise ValueError(f'The URDF has {_named(element)} without the attribute {name!r}')
    return str(found)


def number(element: Any, name: str, default: float | None = None) -> float:
    """
    Read an attribute that is a number.

    Parameters
    ----------
    element
        The element.
    name
        The name of the attribute.
    default
        What counts without the attribute; None if it must be there.

    Raises
    ------
    ValueError
        The attribute is missing or no number.

    """
    return numbers(element, name, None if default is None else (default,), 1)[0]


def numbers(
    element: Any, name: str, default: Sequence[float] | None = None, count: int = 3
) -> list[float]:
    """
    Read an attribute that is several numbers.

    Parameters
    ----------
    element
        The element.
    name
        The name of the attribute.
    default
        What counts without the attribute; None if it must be there.
    count
        How many numbers there must be.

    Raises
    ------
    ValueError
        The attribute is missing, or has something else.

    """
    if default is not None and element.get(name) is None:
        return list(default)
    written = text(element, name)
    try:
        found = [float(each) for each in written.split()]
    except ValueError:
        found = []
    if len(found) != count:
        wanted = 'a number' if count == 1 else f'{count} numbers'
        raise ValueError(
            f'The URDF has {_named(element)} whose attribute {name!r} is {written!r}, but must be '
            f'{wanted}'
        )
    return found


def add(parent: Element | None, tag: str, **attributes: Any) -> Element:
    """
    Create an element.

    Parameters
    ----------
    parent
        The element to add it to, if there is one.
    tag
        Its tag.
    **attributes
        Its attributes: texts, numbers or several numbers; None for none.

    """
    given = {name: _written(value) for name, value in attributes.items() if value is not None}
    if parent is None:
        return Element(tag, given)
    return ElementTree.SubElement(parent, tag, given)


def _written(value: Any) -> str:
    if isinstance(value, str):
        return value
    if isinstance(value, Sequence):
        return ' '.join(_written(each) for each in value)
    return f'{value:.12g}' if isinstance(value, float) else str(value)


def _named(element: Any) -> str:
    name = element.get('name')
    return f'a <{element.tag}>' + (f' named {name!r}' if name else '')
