# SPDX-License-Identifier: Apache-2.0
"""Read XML so that each element and attribute knows its place."""

from __future__ import annotations

from collections.abc import Iterator
import contextlib
import os
from typing import Any, Optional
from xml.dom import expatbuilder
from xml.parsers.expat import ErrorString, ExpatError

import xacro
from xacro_program.place import Place, place_of, PlacedText, put_place


class BrokenXmlError(Exception):
    """A file is not well-formed XML."""

    def __init__(self, place: Place, reason: str, inside: str) -> None:
        """Create it with the innermost open element, empty if there is none."""
        super().__init__(reason)
        self.place = place
        self.reason = reason
        self.inside = inside


class _PlacedBuilder(expatbuilder.ExpatBuilderNS):
    """Builds a document of a file; its elements know their places."""

    def __init__(self, path: str) -> None:
        super().__init__()
        self._path = path

    def start_element_handler(self, name: str, attributes: list[str]) -> None:
        """Add an element."""
        parser = self.getParser()
        line, column = parser.CurrentLineNumber, parser.CurrentColumnNumber + 1
        place = Place(self._path, line, column, parser.CurrentByteIndex)
        for index in range(1, len(attributes), 2):
            text = attributes[index] = PlacedText(attributes[index])
            text.place = place
        super().start_element_handler(name, attributes)
        put_place(self.curNode, place)

    def open_element(self) -> str:
        """Return the element that is open and where it begins, empty if there is none."""
        place = place_of(self.curNode)
        return f'<{self.curNode.nodeName}> of line {place.line}' if place else ''


def parse_placed(path: str) -> Any:
    """
    Parse an XML file into a DOM document whose elements know their places.

    Parameters
    ----------
    path
        The file.

    Raises
    ------
    BrokenXmlError
        The file is not well-formed.
    OSError
        It cannot be read.

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
    """Have xacro read all its files so while this is active."""
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
