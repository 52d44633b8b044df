# SPDX-License-Identifier: Apache-2.0
"""Where something stands in a file."""

from __future__ import annotations

import re
from typing import Any, NamedTuple, Optional
from xml.dom import Node

KEY = 'place'


class Place(NamedTuple):
    """The start of an element, or something within it."""

    file: str
    line: int
    column: int
    byte: int = 0

    def __str__(self) -> str:
        return f'{self.file}:{self.line}'

    def of(self, code: str, in_tag: bool) -> Place:
        """Return where a piece of the element's text stands, or this if it is not found."""
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
    """The text of an attribute, which knows the place of its element wherever it is passed on."""

    __slots__ = ('place',)
    place: Place


class _ToClones:
    """Gives clones of an element, such as the bodies of macros, the element's place."""

    def handle(self, operation: int, key: str, data: Any, source: Any, clone: Any) -> None:
        clone.setUserData(key, data, self)


_TO_CLONES = _ToClones()


def put_place(element: Any, place: Place) -> None:
    """Note the place of an element in itself."""
    element.setUserData(KEY, place, _TO_CLONES)


def place_of(node: Any) -> Optional[Place]:
    """Return the place of an element, or of the closest element around a node."""
    while node is not None and node.nodeType != Node.DOCUMENT_NODE:
        place: Optional[Place] = node.getUserData(KEY)
        if place is not None:
            return place
        node = node.parentNode
    return None
