# SPDX-License-Identifier: Apache-2.0
"""Read XML into a tree that knows the lines of its elements."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Optional, TYPE_CHECKING, Union

if TYPE_CHECKING:
    from xml.parsers.expat import XMLParserType


@dataclass
class Element:
    """An element, with the line on which it begins."""

    tag: str
    attributes: dict[str, str]
    line: int
    children: list[Element] = field(default_factory=list)


class NotXMLError(Exception):
    """A text is not XML; the error knows the line."""

    def __init__(self, text: str, line: int) -> None:
        """Create the error."""
        super().__init__(text)
        self.line = line


def read_tree(content: Union[str, bytes]) -> Element:
    """
    Read XML into a tree whose elements know their lines.

    Parameters
    ----------
    content
        The text of the document.

    Returns
    -------
    Element
        The root.

    Raises
    ------
    NotXMLError
        The text is not XML.

    """
    from xml.parsers.expat import ExpatError, ParserCreate

    parser = ParserCreate()
    builder = _Builder(parser)
    try:
        parser.Parse(content, True)
    except ExpatError as error:
        raise NotXMLError(str(error), error.lineno) from None
    assert builder.root is not None, 'XML has a root'
    return builder.root


class _Builder:
    """Builds the tree while the parser walks through the text."""

    def __init__(self, parser: XMLParserType) -> None:
        self.root: Optional[Element] = None
        self._open: list[Element] = []
        self._parser = parser
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        element = Element(tag, attributes, self._parser.CurrentLineNumber)
        if self._open:
            self._open[-1].children.append(element)
        else:
            self.root = element
        self._open.append(element)

    def _end(self, tag: str) -> None:
        self._open.pop()
