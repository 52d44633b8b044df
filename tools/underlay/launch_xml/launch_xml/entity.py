# SPDX-License-Identifier: Apache-2.0
"""An element of a launch file in XML, and how the file is read into elements."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Optional, TYPE_CHECKING, Union

from launch.failures import CallSite
from launch.frontend.entity import Entity as BaseEntity
from launch.frontend.entity import wrong_value
from launch.frontend.type_utils import value_of_text, value_of_texts

if TYPE_CHECKING:
    from xml.parsers.expat import XMLParserType

_SEPARATOR = '-sep'


class Entity(BaseEntity):
    """
    An element; the values of its attributes get the types that are asked for.

    Parameters
    ----------
    element
        The element of the tree that was read, with its children.
    file_name
        The file that it is in, for error messages.
    parent
        The element around this one, None for the root.

    """

    def __init__(
        self,
        element: _Element,
        *,
        file_name: str = '<string>',
        parent: Optional[BaseEntity] = None,
    ) -> None:
        super().__init__(element.tag, parent=parent, call_site=CallSite(file_name, element.line))
        self.__attributes = element.attributes
        self.__children = [
            Entity(child, file_name=file_name, parent=self) for child in element.children
        ]
        self.__read_attributes: set[str] = set()
        self.__read_tags: set[str] = set()

    @property
    def children(self) -> list[BaseEntity]:
        """Return the elements in this one."""
        self.__read_tags.update(child.type_name for child in self.__children)
        return list(self.__children)

    def _children_of_type(self, name: str) -> list[BaseEntity]:
        self.__read_tags.add(name)
        return [child for child in self.__children if child.type_name == name]

    def _value(self, name: str, data_type: Any, can_be_str: bool) -> Any:
        self.__read_attributes.update((name, name + _SEPARATOR))
        if name not in self.__attributes:
            return None
        text = self.__attributes[name]
        separator = self.__attributes.get(name + _SEPARATOR)
        try:
            if separator:
                return value_of_texts(text.split(separator), data_type, can_be_str)
            return value_of_text(text, data_type, can_be_str)
        except (TypeError, ValueError) as error:
            raise type(error)(wrong_value(self, name, error)) from error

    def _left(self) -> list[tuple[str, list[str]]]:
        tags = dict.fromkeys(child.type_name for child in self.__children)
        return [
            ('attribute(s)', [n for n in self.__attributes if n not in self.__read_attributes]),
            ('nested tag(s)', [tag for tag in tags if tag not in self.__read_tags]),
        ]


@dataclass
class _Element:
    """An element, with the line on which it begins."""

    tag: str
    attributes: dict[str, str]
    line: int
    children: list[_Element] = field(default_factory=list)


class NotXMLError(Exception):
    """A text is not XML; the error knows the line."""

    def __init__(self, text: str, line: int) -> None:
        """Create the error."""
        super().__init__(text)
        self.line = line


def read_tree(content: Union[str, bytes]) -> _Element:
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
        self.root: Optional[_Element] = None
        self._open: list[_Element] = []
        self._parser = parser
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        element = _Element(tag, attributes, self._parser.CurrentLineNumber)
        if self._open:
            self._open[-1].children.append(element)
        else:
            self.root = element
        self._open.append(element)

    def _end(self, tag: str) -> None:
        self._open.pop()
