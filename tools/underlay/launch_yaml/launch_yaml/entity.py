# SPDX-License-Identifier: Apache-2.0
"""An element of a launch file in YAML, and how the file is read, with its lines."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, Optional, Union

from launch.failures import CallSite
from launch.frontend.entity import Entity as BaseEntity
from launch.frontend.entity import wrong_value
from launch.frontend.type_utils import checked_value
import yaml

_CHILDREN = 'children'

_Base: Any = getattr(yaml, 'CSafeLoader', yaml.SafeLoader)


class Entity(BaseEntity):
    """
    A key with what lies below it: a dictionary of attributes, or a list of children.

    Parameters
    ----------
    element
        What lies below the key; None is an empty dictionary.
    type_name
        The key.
    file_name, line
        Where the element begins, for error messages; lines count from 1.
    parent
        The element around this one, None for the root.

    """

    def __init__(
        self,
        element: Any,
        type_name: str,
        *,
        file_name: str = '<string>',
        line: int = 1,
        parent: Optional[BaseEntity] = None,
    ) -> None:
        super().__init__(type_name, parent=parent, call_site=CallSite(file_name, line))
        self.__element = {} if element is None else element
        self.__file_name = file_name
        self.__line = line
        self.__read: set[str] = set()

    @property
    def children(self) -> list[BaseEntity]:
        """Return the elements in this one."""
        self.__read.add(_CHILDREN)
        items = self.__element
        if isinstance(items, dict):
            items = items.get(_CHILDREN) or []
        return [self._child(item) for item in self._checked_list(items, _CHILDREN)]

    def _child(self, item: Any) -> Entity:
        if not isinstance(item, dict) or len(item) != 1:
            raise RuntimeError(
                f'each child of `{self.type_name}` must be one key with its content below it, '
                f"such as '- log: {{message: hello}}', but one is {item!r}"
            )
        [(key, content)] = item.items()
        return self._below(str(key), content, item)

    def _children_of_type(self, name: str) -> list[BaseEntity]:
        self.__read.add(name)
        items = self._attributes().get(name) or []
        return [self._below(name, item, item) for item in self._checked_list(items, name)]

    def _below(self, type_name: str, content: Any, place: Any) -> Entity:
        line = getattr(place, 'line', self.__line)
        return Entity(content, type_name, file_name=self.__file_name, line=line, parent=self)

    def _checked_list(self, items: Any, name: str) -> Iterable[Any]:
        if isinstance(items, list):
            return items
        raise TypeError(
            f"'{name}' of `{self.type_name}` must be a list, but it is {items!r}; begin each item "
            "with '- '"
        )

    def _value(self, name: str, data_type: Any, can_be_str: bool) -> Any:
        self.__read.add(name)
        if name not in self._attributes():
            return None
        try:
            return checked_value(self._attributes()[name], data_type, can_be_str)
        except (TypeError, ValueError) as error:
            raise type(error)(wrong_value(self, name, error)) from error

    def _attributes(self) -> dict[Any, Any]:
        return self.__element if isinstance(self.__element, dict) else {}

    def _left(self) -> list[tuple[str, list[str]]]:
        if not isinstance(self.__element, dict) and _CHILDREN not in self.__read:
            return [('value(s)', [str(self.__element)])]
        return [('key(s)', [str(key) for key in self._attributes() if key not in self.__read])]


class _Mapping(dict[Any, Any]):
    """A dictionary with the line on which it begins."""

    line = 1


class _Sequence(list[Any]):
    """A list with the line on which it begins."""

    line = 1


class NotYAMLError(Exception):
    """A text is not YAML; the error knows the line."""

    def __init__(self, error: yaml.YAMLError) -> None:
        """Create the error from what PyYAML found."""
        super().__init__(str(error))
        mark = getattr(error, 'problem_mark', None)
        self.line = 1 if mark is None else mark.line + 1


class _Loader(_Base):
    """A safe loader whose lists and dictionaries know their lines."""

    def _mapping(self, node: yaml.MappingNode) -> Iterator[_Mapping]:
        mapping = _Mapping()
        mapping.line = node.start_mark.line + 1
        yield mapping
        mapping.update(self.construct_mapping(node, deep=True))

    def _sequence(self, node: yaml.SequenceNode) -> Iterator[_Sequence]:
        sequence = _Sequence()
        sequence.line = node.start_mark.line + 1
        yield sequence
        sequence.extend(self.construct_sequence(node, deep=True))


_Loader.add_constructor('tag:yaml.org,2002:map', _Loader._mapping)
_Loader.add_constructor('tag:yaml.org,2002:seq', _Loader._sequence)


def read_document(content: Union[str, bytes]) -> Any:
    """
    Read a YAML document whose lists and dictionaries know their lines.

    Parameters
    ----------
    content
        The text of the document.

    Returns
    -------
    Any
        Nested Mapping and Sequence with scalars in them; None if it is empty.

    Raises
    ------
    NotYAMLError
        The text is not YAML.

    """
    try:
        return yaml.load(content, Loader=_Loader)  # noqa: S506
    except yaml.YAMLError as error:
        raise NotYAMLError(error) from None
