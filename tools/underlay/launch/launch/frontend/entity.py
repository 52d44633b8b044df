# SPDX-License-Identifier: Apache-2.0
"""An element of a launch file, in any format."""

from __future__ import annotations

from itertools import count
from typing import Any, Optional, TYPE_CHECKING

from launch.frontend._complaints import missing_attribute, unexpected_names
from launch.frontend.type_utils import check_is_list_entity

if TYPE_CHECKING:
    from launch._call_site import CallSite

_numbers = count(1)


class Entity:
    """
    Element of a launch file, which records the attributes and children that have been read.

    Each format derives from this class and implements the access to attributes and children. The
    elements of a file are created in the order of the file.

    Parameters
    ----------
    type_name
        The tag of the element.
    parent
        The parent element, None for the root.
    call_site
        The line of the element in the file, if it is known.

    Attributes
    ----------
    order
        A number that is greater than those of all elements before it in the file.

    """

    order = 0

    def __init__(
        self,
        type_name: str,
        *,
        parent: Optional[Entity] = None,
        call_site: Optional[CallSite] = None,
    ) -> None:
        self.__type_name = type_name
        self.__parent = parent
        self.__asked: list[str] = []
        self.call_site = call_site
        self.order = next(_numbers)

    @property
    def type_name(self) -> str:
        """Return the tag."""
        return self.__type_name

    @property
    def parent(self) -> Optional[Entity]:
        """Return the parent element, None for the root."""
        return self.__parent

    @property
    def children(self) -> list[Entity]:
        """Return the child elements; subclasses override this."""
        raise NotImplementedError

    def get_attr(
        self,
        name: str,
        *,
        data_type: Any = str,
        optional: bool = False,
        can_be_str: bool = True,
    ) -> Any:
        """
        Get the value of an attribute, or the children with a tag.

        Parameters
        ----------
        name
            The attribute, or the tag.
        data_type
            str, int, float, bool, a list of one of them, None for any of those, or List[Entity]
            for children.
        optional
            Whether to return None if there is none, rather than raise an error.
        can_be_str
            Whether a value with substitutions is returned as a string.

        Raises
        ------
        AttributeError
            There is no such attribute or child, and it is not optional.
        TypeError
            The value cannot be converted to the type.

        """
        self.__asked.append(name)
        if check_is_list_entity(data_type):
            value = self._children_of_type(name) or None
        else:
            value = self._value(name, data_type, can_be_str)
        if value is None and not optional:
            raise AttributeError(missing_attribute(self, name, data_type, self._names_left()))
        return value

    def assert_entity_completely_parsed(self) -> None:
        """Raise a ValueError if the element has attributes or children that have not been read."""
        for kind, names in self._left():
            if names:
                raise ValueError(unexpected_names(self, kind, names, self.__asked))

    def _names_left(self) -> list[str]:
        return [name for _, names in self._left() for name in names]

    def _value(self, name: str, data_type: Any, can_be_str: bool) -> Any:
        """Return the value of an attribute, None if there is none."""
        raise NotImplementedError

    def _children_of_type(self, name: str) -> list[Entity]:
        """Return the children with a tag."""
        raise NotImplementedError

    def _left(self) -> list[tuple[str, list[str]]]:
        """Return the names of attributes and children that have not been read, by kind."""
        raise NotImplementedError
