# SPDX-License-Identifier: Apache-2.0
"""Parse XML with source locations of elements and attributes."""

from __future__ import annotations

from collections.abc import Iterator
import contextlib
import os
import re
from typing import Any, NamedTuple, Optional
from xml.dom import expatbuilder, Node
from xml.parsers.expat import ErrorString, ExpatError

import xacro

KEY = 'place'


class Place(NamedTuple):
    """Source location of an element, or of text in it."""

    file: str
    line: int
    column: int
    byte: int = 0

    def __str__(self) -> str:
        return f'{self.file}:{self.line}'

    def of(self, code: str, in_tag: bool) -> Place:
        """
        Locate an expression in the element; return this place if it is not found.

        Parameters
        ----------
        code
            The expression, including `${...}` or `$(...)`.
        in_tag
            Whether the expression is in the tag of the element, as in attributes, not below it.

        """
        with open(self.file, 'rb') as source:
            source.seek(self.byte)
            text = source.read().decode('utf-8', 'replace')
        end = text.find('<', 1) if in_tag else len(text)
        match = re.search(re.escape(code).replace('\\ ', r'\s'), text[:end])
        if match is None:
            return self
        before = text[: match.start()]
        lines = before.count('\n')
        column = len(before) - before.rfind('\n') if lines else self.column + len(before)
        return self._replace(line=self.line + lines, column=column)


class PlacedText(str):
    """Attribute text that carries the source location of its element."""

    __slots__ = ('place',)
    place: Place


class _ToClones:
    """User data handler that copies the place of an element to its clones (macro bodies)."""

    def handle(self, operation: int, key: str, data: Any, source: Any, clone: Any) -> None:
        clone.setUserData(key, data, self)


_TO_CLONES = _ToClones()


def put_place(element: Any, place: Place) -> None:
    """
    Store the place of an element in the element itself; it is copied to clones.

    Parameters
    ----------
    element
        The DOM element.
    place
        The start of the element in its file.

    """
    element.setUserData(KEY, place, _TO_CLONES)


def place_of(node: Any) -> Optional[Place]:
    """
    Return the place of a node or its closest ancestor that has one; None if there is none.

    Parameters
    ----------
    node
        A DOM node, or None.

    """
    while node is not None and node.nodeType != Node.DOCUMENT_NODE:
        place: Optional[Place] = node.getUserData(KEY)
        if place is not None:
            return place
        node = node.parentNode
    return None


class BrokenXmlError(Exception):
    """A file is not well-formed XML."""

    def __init__(self, place: Place, reason: str, inside: str) -> None:
        """Create the error; `inside` is the innermost open element, or empty."""
        super().__init__(reason)
        self.place = place
        self.reason = reason
        self.inside = inside


class _PlacedBuilder(expatbuilder.ExpatBuilderNS):
    """DOM builder that stores the source location in each element."""

    def __init__(self, path: str) -> None:
        super().__init__()
        self._path = path

    def start_element_handler(self, name: str, attributes: list[str]) -> None:
        """Add an element with its source location."""
        parser = self.getParser()
        line, column = parser.CurrentLineNumber, parser.CurrentColumnNumber + 1
        place = Place(self._path, line, column, parser.CurrentByteIndex)
        for index in range(1, len(attributes), 2):
            text = attributes[index] = PlacedText(attributes[index])
            text.place = place
        super().start_element_handler(name, attributes)
        put_place(self.curNode, place)

    def open_element(self) -> str:
        """Describe the innermost open element and its line; empty if there is none."""
        place = place_of(self.curNode)
        return f'<{self.curNode.nodeName}> of line {place.line}' if place else ''


def parse_placed(path: str) -> Any:
    """
    Parse an XML file into a DOM document with source locations.

    Parameters
    ----------
    path
        The file.

    Raises
    ------
    BrokenXmlError
        The file is not well-formed.
    OSError
        The file cannot be read.

    """
    builder = _PlacedBuilder(path)
    with open(path, 'rb') as file:
        try:
            return builder.parseFile(file)
        except ExpatError as error:
            place = Place(path, error.lineno, error.offset + 1)
            reason = ErrorString(error.code) or str(error)
            raise BrokenXmlError(place, reason, builder.open_element()) from None


@contextlib.contextmanager
def placed_documents() -> Iterator[None]:
    """Patch xacro to parse all files with source locations while this context is active."""
    original = xacro.parse

    def parse(inp: Any, filename: Optional[str] = None) -> Any:
        if inp is not None or filename is None:
            return original(inp, filename)
        try:
            placed = parse_placed(os.path.normpath(os.path.join(xacro.root_dir, filename)))
        except OSError:
            placed = None
        return original(placed, filename)

    xacro.parse = parse
    try:
        yield
    finally:
        xacro.parse = original
