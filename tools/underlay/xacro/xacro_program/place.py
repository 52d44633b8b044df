# SPDX-License-Identifier: Apache-2.0
"""Source locations in XML files."""

from __future__ import annotations

import re
from typing import Any, NamedTuple, Optional
from xml.dom import Node

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
