# SPDX-License-Identifier: Apache-2.0
"""XML elements with line numbers, and their attributes, with errors that state the location."""

from __future__ import annotations

from dataclasses import dataclass, field
import math
from xml.parsers import expat

from urdf.robot_model import Origin, Vector

__all__ = [
    'UrdfError',
    'XmlElement',
    'child',
    'number',
    'origin_of',
    'parse_xml',
    'text',
    'vector',
]

NO_MOVE = (0.0, 0.0, 0.0)


class UrdfError(ValueError):
    """A URDF is invalid; with the reason and the line to correct."""

    def __init__(self, reason: str, line: int | None = None, source: str | None = None) -> None:
        """Create the error; the source is the file or another origin of the text."""
        super().__init__(reason)
        self.reason = reason
        self.line = line
        self.source = source

    def __str__(self) -> str:
        """Return the reason, preceded by the source and line if known."""
        place = [] if self.source is None else [self.source]
        if self.line is not None:
            place.append(str(self.line) if place else f'line {self.line}')
        return ': '.join(filter(None, [':'.join(place), self.reason]))


@dataclass
class XmlElement:
    """An XML element and the line on which it starts."""

    tag: str
    attributes: dict[str, str]
    line: int
    children: list[XmlElement] = field(default_factory=list)

    def find(self, tag: str) -> XmlElement | None:
        """
        Find the first child element with a tag.

        Parameters
        ----------
        tag
            The tag name.

        Returns
        -------
        XmlElement or None
            The element, or None if there is none.

        """
        return next((child for child in self.children if child.tag == tag), None)

    def find_all(self, tag: str) -> list[XmlElement]:
        """
        List the direct child elements with a tag.

        Parameters
        ----------
        tag
            The tag name.

        """
        return [child for child in self.children if child.tag == tag]


def parse_xml(text: str) -> XmlElement:
    """
    Parse XML into elements with line numbers.

    Parameters
    ----------
    text
        The document.

    Returns
    -------
    XmlElement
        The root element.

    Raises
    ------
    UrdfError
        The text is not valid XML.

    """
    parser = expat.ParserCreate(encoding='utf-8')
    document = XmlElement('', {}, 0)
    open_elements = [document]

    def start(tag: str, attributes: dict[str, str]) -> None:
        element = XmlElement(tag, attributes, parser.CurrentLineNumber)
        open_elements[-1].children.append(element)
        open_elements.append(element)

    parser.StartElementHandler = start
    parser.EndElementHandler = lambda tag: open_elements.pop()
    try:
        parser.Parse(text.encode(errors='replace'), True)
    except expat.ExpatError as error:
        raise _explained(error, open_elements) from error
    return document.children[0]


def _explained(error: expat.ExpatError, open_elements: list[XmlElement]) -> UrdfError:
    """Create an error that names the element that is open where the XML is invalid."""
    what = expat.ErrorString(error.code)
    inside = open_elements[-1]
    where = f' It is inside <{inside.tag}> of line {inside.line}.' if inside.tag else ''
    return UrdfError(f'The text is not valid XML: {what}.{where}', error.lineno)


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
        raise _not('three numbers separated by spaces', element, name, where)
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
