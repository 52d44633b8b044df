# SPDX-License-Identifier: Apache-2.0
"""An element of a launch file in XML."""

from __future__ import annotations

from typing import Any, Optional

from launch._call_site import CallSite
from launch.frontend._complaints import wrong_value
from launch.frontend.entity import Entity as BaseEntity
from launch.frontend.type_utils import value_of_text, value_of_texts
from launch_xml._tree import Element

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
        element: Element,
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
