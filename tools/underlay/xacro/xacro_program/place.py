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
        """
        Return the place of a piece of code in the element, or this place if it is not found.

        Parameters
        ----------
        code
            The code, with `${...}` or `$(...)` around it.
        in_tag
            Whether it stands in the tag of the element, as attributes do, and not below it.

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
    """The text of an attribute, which knows the place of its element wherever it is passed on."""

    __slots__ = ('place',)
    place: Place


class _ToClones:
    """Gives clones of an element, such as the bodies of macros, the element's place."""

    def handle(self, operation: int, key: str, data: Any, source: Any, clone: Any) -> None:
        clone.setUserData(key, data, self)


_TO_CLONES = _ToClones()


def put_place(element: Any, place: Place) -> None:
    """
    Store the place of an element in the element itself; clones get it, too.

    Parameters
    ----------
    element
        The DOM element.
    place
        Where it begins in its file.

    """
    element.setUserData(KEY, place, _TO_CLONES)


def place_of(node: Any) -> Optional[Place]:
    """
    Return the place of the closest element that has one, from a node upwards; None without any.

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
