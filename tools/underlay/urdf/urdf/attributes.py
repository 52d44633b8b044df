# SPDX-License-Identifier: Apache-2.0
"""Read attributes of elements, with errors that say where they are."""

from __future__ import annotations

import math

from urdf.joint import Origin, Vector
from urdf.urdf_error import UrdfError
from urdf.xml_element import XmlElement

__all__ = ['child', 'number', 'origin_of', 'text', 'vector']

NO_MOVE = (0.0, 0.0, 0.0)


def child(element: XmlElement, tag: str, where: str) -> XmlElement:
    """Return the child element that must be there."""
    found = element.find(tag)
    if found is None:
        raise UrdfError(f'There is no <{tag}> in {where}. Add it.', element.line)
    return found


def text(element: XmlElement, name: str, where: str) -> str:
    """Return the attribute that must be there."""
    value = element.attributes.get(name, '')
    if not value:
        raise UrdfError(f"There is no attribute '{name}' in {where}. Add it.", element.line)
    return value


def number(element: XmlElement, name: str, where: str, default: float) -> float:
    """Return an attribute that is a number."""
    given = element.attributes.get(name)
    if given is None:
        return default
    numbers = _numbers(given)
    if numbers is None or len(numbers) != 1:
        raise _not('a number', element, name, where)
    return numbers[0]


def vector(element: XmlElement | None, name: str, where: str, default: Vector) -> Vector:
    """Return an attribute that is three numbers."""
    given = element.attributes.get(name) if element is not None else None
    if element is None or given is None:
        return default
    numbers = _numbers(given)
    if numbers is None or len(numbers) != 3:
        raise _not('three numbers with spaces between them', element, name, where)
    return numbers[0], numbers[1], numbers[2]


def origin_of(element: XmlElement, where: str) -> Origin:
    """Return where an element is in the frame of its link; at its origin if nothing is said."""
    origin = element.find('origin')
    return Origin(vector(origin, 'xyz', where, NO_MOVE), vector(origin, 'rpy', where, NO_MOVE))


def _numbers(given: str) -> list[float] | None:
    """Return the numbers of a text, or None if it has anything else."""
    try:
        numbers = [float(word) for word in given.split()]
    except ValueError:
        return None
    return numbers if all(map(math.isfinite, numbers)) else None


def _not(wanted: str, element: XmlElement, name: str, where: str) -> UrdfError:
    given = element.attributes[name]
    return UrdfError(
        f"'{name}' in <{element.tag}> of {where} is '{given}', but must be {wanted}.",
        element.line,
    )
