# SPDX-License-Identifier: Apache-2.0
"""Definitions of interfaces, with those of nested types, and instances with default values."""

from __future__ import annotations

from collections.abc import Iterator
import os
import re
from typing import Any, NamedTuple

from ros2cli.messages.lookup import get_passed_type, KINDS
from ros2interface.api import (
    get_interface_packages,
    get_interfaces,
    HEADINGS,
    unknown_package_text,
)
from ros2pkg.api import get_share_directory

FIELD = re.compile(r'\s*(?P<type>[A-Za-z][A-Za-z0-9_/]*)(\[[^\]]*\])?\s+[a-z][A-Za-z0-9_]*\b')
COMMENT = re.compile(r"""#.*|("[^"]*"|'[^']*')""")
IDL_COMMENT = re.compile(r'//[^\n]*|/\*.*?\*/|("(?:\\.|[^"\\])*")', re.DOTALL)
PRIMITIVES = frozenset(
    'bool byte char float32 float64 int8 uint8 int16 uint16 int32 uint32 int64 uint64 string '
    'wstring'.split()
)
TYPES_OF_OLD = {'Header': 'std_msgs/msg/Header'}
PARTS = {'srv': 'Request', 'action': 'Goal'}


class Definition(NamedTuple):
    """The name of an interface, the text that defines it, and whether that is OMG IDL."""

    name: str
    text: str
    is_idl: bool = False


def read_definition(name: str) -> Definition:
    """
    Read the file that defines an interface.

    Parameters
    ----------
    name
        The name as `package/kind/Type`.

    Returns
    -------
    Definition
        The text of the .msg, .srv or .action file, or of the .idl file if there is no other.

    Raises
    ------
    RuntimeError
        There is no such interface; the message states which part of the name is wrong.

    """
    package, kind, type_name = split_name(name)
    stem = os.path.join(get_share_directory(package), kind, type_name)
    for path in (f'{stem}.{kind}', f'{stem}.idl'):
        if os.path.isfile(path):
            with open(path, encoding='utf-8') as stream:
                return Definition(name, stream.read(), path.endswith('.idl'))
    raise RuntimeError(_missing_text(name, f'{stem}.idl'))


def split_name(name: str) -> list[str]:
    """
    Split the name of an interface into package, kind and type, and check that the package exists.

    Parameters
    ----------
    name
        The name as `package/kind/Type`.

    Returns
    -------
    list of str
        The three parts; whether the package has such a type is not checked.

    Raises
    ------
    RuntimeError
        The name does not have three parts, or the package defines no interfaces.

    """
    parts = name.split('/')
    if len(parts) != 3 or not all(parts):
        raise RuntimeError(
            f"Invalid name '{name}'. Expected three parts separated by '/'{_closest(name)}"
        )
    if parts[0] not in get_interface_packages():
        raise RuntimeError(unknown_package_text(parts[0]))
    return parts


def _missing_text(name: str, path: str) -> str:
    return f"Could not find the interface '{path}'{_closest(name)}"


def _closest(name: str) -> str:
    """Return a line that suggests the interface probably meant, or ''."""
    from ros_environment.suggestions import closest_name

    package, _, rest = name.partition('/')
    if not rest or rest in HEADINGS or package not in get_interface_packages():
        return ''
    known = {each.rpartition('/')[2]: each for each in get_interfaces(package, HEADINGS)}
    found = closest_name(name.rpartition('/')[2], known)
    return f'\nDid you mean {known[found]!r}?' if found else ''


def expand(
    definition: Definition, *, all_comments: bool = False, no_comments: bool = False
) -> Iterator[str]:
    """
    Expand a definition: below each field of a message type, that type's own definition.

    Nothing is expanded in a definition in OMG IDL.

    Parameters
    ----------
    definition
        The interface to show.
    all_comments
        Whether comments of the nested definitions are shown, too.
    no_comments
        Whether comments and empty lines are dropped everywhere; this overrides `all_comments`.

    Yields
    ------
    str
        The lines; nested ones begin with a tab for each level.

    Raises
    ------
    RuntimeError
        The type of a field is not installed.

    """
    if definition.is_idl:
        yield from _idl_lines(definition.text, no_comments=no_comments)
        return
    for line in definition.text.splitlines():
        shown = _without_comment(line) if no_comments else line
        if shown.strip() or not no_comments:
            yield shown
        for nested in _nested_lines(line, definition.name, all_comments and not no_comments):
            yield f'\t{nested}' if nested else ''


def _idl_lines(text: str, *, no_comments: bool) -> Iterator[str]:
    """Yield the lines of an .idl file, optionally without comments and empty lines."""
    if no_comments:
        text = IDL_COMMENT.sub(lambda match: match[1] or '', text)
    for line in text.splitlines():
        if line.strip() or not no_comments:
            yield line.rstrip() if no_comments else line


def _nested_lines(line: str, name: str, with_comments: bool) -> Iterator[str]:
    type_name = field_type(line, name.partition('/')[0])
    if type_name is not None:
        yield from expand(
            read_definition(type_name), all_comments=with_comments, no_comments=not with_comments
        )


def field_type(line: str, package: str) -> str | None:
    """
    Find the message type of a field in a line of a definition.

    Parameters
    ----------
    line
        The line, possibly with a comment.
    package
        The package of the definition, to which types without a package belong.

    Returns
    -------
    str or None
        The type as `package/msg/Type`, without array bounds; None for fields of primitive types
        and for all other lines.

    """
    field = FIELD.match(_without_comment(line))
    if not field or field['type'] in PRIMITIVES:
        return None
    parts = field['type'].split('/')
    if len(parts) == 1:
        return TYPES_OF_OLD.get(parts[0], f'{package}/msg/{parts[0]}')
    return f'{parts[0]}/msg/{parts[-1]}'


def _without_comment(line: str) -> str:
    """Return a line without its comment; a `#` in quotes does not start one."""
    return COMMENT.sub(lambda match: match[1] or '', line).rstrip()


def create_prototype(name: str) -> Any:
    """
    Create a message, the request of a service or the goal of an action, with default values.

    Parameters
    ----------
    name
        The interface as `package/kind/Type`.

    Returns
    -------
    Any
        The instance of the generated class.

    Raises
    ------
    RuntimeError
        There is no such interface, or its class cannot be imported.

    """
    _, kind, _ = split_name(name)
    if kind not in KINDS:
        raise RuntimeError(f"Unknown kind of interface '{kind}' in '{name}': {', '.join(KINDS)}")
    read_definition(name)
    interface = get_passed_type(name, kind)
    return getattr(interface, PARTS[kind])() if kind in PARTS else interface()
