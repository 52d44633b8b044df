# SPDX-License-Identifier: Apache-2.0
"""An element of a launch file, in any format, and the errors about what is wrong in it."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import count
from typing import Any, get_args, get_origin, Optional, TYPE_CHECKING

from ros_environment.suggestions import did_you_mean

if TYPE_CHECKING:
    from launch.failures import CallSite

_numbers = count(1)

_ATTRIBUTES = {
    ('node', 'type'): "write 'exec'",
    ('node', 'package'): "XML and YAML write 'pkg'",
    ('node', 'executable'): "XML and YAML write 'exec'",
    ('composable_node', 'package'): "XML and YAML write 'pkg'",
    ('node', 'required'): 'write on_exit="shutdown"',
    ('node', 'ns'): "write 'namespace'",
    ('node', 'launch_prefix'): "write 'launch-prefix'",
    ('executable', 'launch_prefix'): "write 'launch-prefix'",
    ('group', 'ns'): 'write <push_ros_namespace namespace="..."/> in it',
    ('include', 'ns'): 'put it in a group with <push_ros_namespace namespace="..."/>',
    ('include', 'pass_all_args'): 'an included file sees all variables anyway',
    ('arg', 'value'): 'write <let name="..." value="..."/>, or \'default\'',
    ('arg', 'doc'): "write 'description'",
}


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


def check_is_list_entity(data_type: Any) -> bool:
    """
    Whether a type is a list of elements, such as `List[Entity]`.

    Parameters
    ----------
    data_type
        Any type, or None.

    """
    if get_origin(data_type) is not list:
        return False
    (item,) = get_args(data_type)
    return isinstance(item, type) and issubclass(item, Entity)


def missing_attribute(entity: Entity, name: str, data_type: Any, left: list[str]) -> str:
    """
    Format the error about a missing attribute, with suggestions.

    Parameters
    ----------
    entity
        The element.
    name, data_type
        The attribute that was asked for, and its type.
    left
        The names of attributes and children that have not been read.

    """
    text = f"Attribute '{name}' of type '{data_type}' not found in Entity '{entity.type_name}'"
    return _with_advice(text, [_legacy(entity, each) or _instead(each, name) for each in left])


def unexpected_names(entity: Entity, kind: str, names: list[str], known: list[str]) -> str:
    """
    Format the error about attributes or children that an element cannot have.

    Parameters
    ----------
    entity
        The element.
    kind
        Their kind: `attribute(s)` or `nested tag(s)`.
    names
        Their names.
    known
        The names that the element can have, for suggestions.

    """
    listed = ', '.join(f"'{name}'" for name in sorted(set(names)))
    text = f'Unexpected {kind} found in `{entity.type_name}`: {{{listed}}}'
    return _with_advice(text, [_legacy(entity, each) or _meant(each, known) for each in names])


def wrong_value(entity: Entity, name: str, error: Exception) -> str:
    """
    Format the error about an attribute whose value cannot be used.

    Parameters
    ----------
    entity, name
        The element, and the attribute.
    error
        The error about the value.

    """
    return f"The attribute '{name}' of `{entity.type_name}` cannot be used: {error}"


def _meant(name: str, known: list[str]) -> str:
    return did_you_mean(name, [each for each in known if each != name])


def _instead(given: str, missing: str) -> str:
    close = did_you_mean(given, [missing])
    return f"There is '{given}' instead: was '{missing}' meant?" if close else ''


def _legacy(entity: Entity, name: str) -> str:
    advice = _ATTRIBUTES.get((entity.type_name, name))
    return f"ROS 2 has no '{name}' there: {advice}." if advice else ''


def _with_advice(text: str, advice: Iterable[str]) -> str:
    return '\n'.join([text, *filter(None, advice)])
