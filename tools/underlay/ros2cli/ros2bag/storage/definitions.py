# SPDX-License-Identifier: Apache-2.0
"""Message definitions with all nested types, from the installed files."""

from __future__ import annotations

from collections.abc import Callable, Iterator
import os
import re
from typing import NamedTuple

__all__ = ['Definition', 'definition_of']

SEPARATOR = '=' * 80
PRIMITIVES = frozenset(
    'bool byte char float32 float64 int8 uint8 int16 uint16 int32 uint32 int64 uint64 '
    'string wstring'.split()
)
FIELD_TYPE = re.compile(r'\s*([A-Za-z][A-Za-z0-9_/]*)')


class Definition(NamedTuple):
    """The text and the encoding of a definition; both empty if it is unknown."""

    encoding: str = ''
    text: str = ''


def definition_of(type_name: str, find_share: Callable[[str], str]) -> Definition:
    """
    Return the `ros2msg` definition of a message type, with those of nested types appended.

    Parameters
    ----------
    type_name
        `package/msg/Name` or `package/Name`.
    find_share
        Returns the share folder of a package; raises LookupError if the package is not installed.

    Returns
    -------
    Definition
        Empty if a package or a file is missing, or the type is not a message.

    """
    try:
        return Definition('ros2msg', f'\n{SEPARATOR}\n'.join(_sections(type_name, find_share)))
    except (LookupError, OSError, ValueError):
        return Definition()


def _sections(type_name: str, find_share: Callable[[str], str]) -> Iterator[str]:
    waiting = [_package_and_name(type_name)]
    seen = set(waiting)
    for index, (package, name) in enumerate(waiting):
        text = _read(find_share(package), name)
        yield f'MSG: {package}/{name}\n{text}' if index else text
        for dependency in _dependencies(text, package):
            if dependency not in seen:
                seen.add(dependency)
                waiting.append(dependency)


def _read(share: str, name: str) -> str:
    with open(os.path.join(share, 'msg', f'{name}.msg'), encoding='utf-8') as stream:
        return stream.read()


def _dependencies(text: str, package: str) -> Iterator[tuple[str, str]]:
    """Yield the nested message types of the fields."""
    for line in text.splitlines():
        match = FIELD_TYPE.match(line)
        if match and match[1] not in PRIMITIVES:
            name = match[1]
            yield _package_and_name(name) if '/' in name else (package, name)


def _package_and_name(type_name: str) -> tuple[str, str]:
    """Return the parts of `package/msg/Name` or `package/Name`; other types have no .msg file."""
    package, *kind, name = type_name.split('/')
    if kind not in ([], ['msg']):
        raise ValueError(type_name)
    return package, name
