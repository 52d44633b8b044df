# SPDX-License-Identifier: Apache-2.0
"""XML elements with line numbers."""

from __future__ import annotations

from dataclasses import dataclass, field
from xml.parsers import expat

from urdf.urdf_error import UrdfError

__all__ = ['XmlElement', 'parse_xml']


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
