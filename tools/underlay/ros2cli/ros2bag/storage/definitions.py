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
END_OF_REQUEST = re.compile(r'^---.*$\n?', re.MULTILINE)
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
        `package/msg/Name` or `package/Name`; for the events of a service,
        `package/srv/Name_Event`.
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


class _Type(NamedTuple):
    """A type: a message, or the request, response or event of a service."""

    package: str
    kind: str
    name: str

    @property
    def title(self) -> str:
        """Return the name by which a definition refers to it."""
        kind = '' if self.kind == 'msg' else f'{self.kind}/'
        return f'{self.package}/{kind}{self.name}'


def _sections(type_name: str, find_share: Callable[[str], str]) -> Iterator[str]:
    waiting = [_type_of(type_name)]
    seen = set(waiting)
    for index, each in enumerate(waiting):
        text = _read(find_share(each.package), each)
        yield f'MSG: {each.title}\n{text}' if index else text
        for dependency in _dependencies(text, each.package):
            if dependency not in seen:
                seen.add(dependency)
                waiting.append(dependency)


def _read(share: str, wanted: _Type) -> str:
    """Return the definition of a type, without those of nested ones."""
    if wanted.kind == 'msg':
        return _content(share, 'msg', wanted.name)
    service, _, part = wanted.name.rpartition('_')
    request, response = END_OF_REQUEST.split(_content(share, 'srv', service), maxsplit=1)
    start = f'{wanted.package}/srv/{service}'
    return {
        'Request': request,
        'Response': response,
        'Event': f'service_msgs/ServiceEventInfo info\n{start}_Request[<=1] request\n'
        f'{start}_Response[<=1] response\n',
    }[part]


def _content(share: str, kind: str, name: str) -> str:
    with open(os.path.join(share, kind, f'{name}.{kind}'), encoding='utf-8') as stream:
        return stream.read()


def _dependencies(text: str, package: str) -> Iterator[_Type]:
    """Yield the nested message types of the fields."""
    for line in text.splitlines():
        match = FIELD_TYPE.match(line)
        if match and match[1] not in PRIMITIVES:
            name = match[1]
            yield _type_of(name) if '/' in name else _Type(package, 'msg', name)


def _type_of(type_name: str) -> _Type:
    """Return the parts of `package/msg/Name` or `package/Name`; only services have others."""
    package, *kind, name = type_name.split('/')
    if kind not in ([], ['msg'], ['srv']):
        raise ValueError(type_name)
    return _Type(package, kind[0] if kind else 'msg', name)
