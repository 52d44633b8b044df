# SPDX-License-Identifier: Apache-2.0
"""Expansion of definitions with those of nested types."""

from __future__ import annotations

from collections.abc import Iterator
import re

from ros2interface.api.definition import Definition, read_definition

FIELD = re.compile(r'\s*(?P<type>[A-Za-z][A-Za-z0-9_/]*)(\[[^\]]*\])?\s+[a-z][A-Za-z0-9_]*\b')
COMMENT = re.compile(r"""#.*|("[^"]*"|'[^']*')""")
PRIMITIVES = frozenset(
    'bool byte char float32 float64 int8 uint8 int16 uint16 int32 uint32 int64 uint64 string '
    'wstring'.split()
)
TYPES_OF_OLD = {'Header': 'std_msgs/msg/Header'}


def expand(
    definition: Definition, *, all_comments: bool = False, no_comments: bool = False
) -> Iterator[str]:
    """
    Expand a definition: below each field of a message type, that type's own definition.

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
    for line in definition.text.splitlines():
        shown = _without_comment(line) if no_comments else line
        if shown.strip() or not no_comments:
            yield shown
        for nested in _nested_lines(line, definition.name, all_comments and not no_comments):
            yield f'\t{nested}' if nested else ''


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
