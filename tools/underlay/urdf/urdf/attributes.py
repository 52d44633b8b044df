# SPDX-License-Identifier: Apache-2.0
"""Parse XML attributes, with errors that state the location."""

from __future__ import annotations

import math

from urdf.joint import Origin, Vector
from urdf.urdf_error import UrdfError
from urdf.xml_element import XmlElement

__all__ = ['child', 'number', 'origin_of', 'text', 'vector']

NO_MOVE = (0.0, 0.0, 0.0)


def child(element: XmlElement, tag: str, where: str) -> XmlElement:
    """
    Find a required child element.

    Parameters
    ----------
    element
        The parent element.
    tag
        The tag name of the child.
    where
        Description of the parent element, for the error message: "joint 'hip'".

    Raises
    ------
    UrdfError
        The child element is missing.

    """
    found = element.find(tag)
    if found is None:
        raise UrdfError(f'There is no <{tag}> in {where}. Add it.', element.line)
    return found


def text(element: XmlElement, name: str, where: str) -> str:
    """
    Read a required attribute as text.

    Parameters
    ----------
    element
        The element with the attribute.
    name
        The attribute name.
    where
        Description of the element, for the error message: "<parent> of joint 'hip'".

    Raises
    ------
    UrdfError
        The attribute is missing or empty.

    """
    value = element.attributes.get(name, '')
    if not value:
        raise UrdfError(f"There is no attribute '{name}' in {where}. Add it.", element.line)
    return value


def number(element: XmlElement, name: str, where: str, default: float) -> float:
    """
    Read an optional attribute as a number.

    Parameters
    ----------
    element
        The element with the attribute.
    name
        The attribute name.
    where
        Description of the owner of the element, for the error message: "joint 'hip'".
    default
        The value if the attribute is missing.

    Raises
    ------
    UrdfError
        The attribute is not a single finite number.

    """
    given = element.attributes.get(name)
    if given is None:
        return default
    numbers = _numbers(given)
    if numbers is None or len(numbers) != 1:
        raise _not('a number', element, name, where)
    return numbers[0]


def vector(element: XmlElement | None, name: str, where: str, default: Vector) -> Vector:
    """
    Read an optional attribute as three numbers.

    Parameters
    ----------
    element
        The element with the attribute, if any.
    name
        The attribute name.
    where
        Description of the owner of the element, for the error message: "joint 'hip'".
    default
        The value if the element or the attribute is missing.

    Raises
    ------
    UrdfError
        The attribute is not three finite numbers.

    """
    given = element.attributes.get(name) if element is not None else None
    if element is None or given is None:
        return default
    numbers = _numbers(given)
    if numbers is None or len(numbers) != 3:
        raise _not('three numbers with spaces between them', element, name, where)
    return numbers[0], numbers[1], numbers[2]


def origin_of(element: XmlElement, where: str) -> Origin:
    """
    Parse the `<origin>` of an element; the default is the identity.

    Parameters
    ----------
    element
        The joint, visual or collision.
    where
        Description of the element, for the error message: "joint 'hip'".

    Returns
    -------
    Origin
        xyz in m, and roll, pitch and yaw in rad, in the frame of the (parent) link.

    Raises
    ------
    UrdfError
        An attribute is not three finite numbers.

    """
    origin = element.find('origin')
    return Origin(vector(origin, 'xyz', where, NO_MOVE), vector(origin, 'rpy', where, NO_MOVE))


def _numbers(given: str) -> list[float] | None:
    """Parse finite numbers separated by spaces; None if the text is invalid."""
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
