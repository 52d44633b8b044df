# SPDX-License-Identifier: Apache-2.0
"""Parse XML with source locations of elements and attributes."""

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
