# SPDX-License-Identifier: Apache-2.0
"""Which nodes a parameter file is for."""

from __future__ import annotations

import re
from typing import Optional

_KEY = re.compile(
    r"""^( *)(?:"([^"]*)"|'([^']*)'|([^\s#"'{\[&*!|>%@`?-][^#]*?|/[^#]*?|\*\*)) *:(?:\s|$)"""
)
PARAMETERS = 'ros__parameters'


def parameter_file_keys(path: str) -> list[str]:
    """
    Return the names of nodes in a parameter file, with their wildcards.

    Only the lines are looked at, because reading large files as YAML takes long; a file that
    is not in block style has no names here.
    """
    return _keys(read_lines(path))


def read_lines(path: str) -> list[str]:
    """Return the lines of a file, none if it cannot be read."""
    try:
        with open(path, encoding='utf-8') as file:
            return file.read().splitlines()
    except (OSError, UnicodeDecodeError):
        return []


def key_of(line: str) -> Optional[tuple[str, str]]:
    """Return the spaces before the name that a line begins with, and the name."""
    match = _KEY.match(line)
    if match is None:
        return None
    return match[1], next(each for each in match.groups()[1:] if each is not None)


def _keys(lines: list[str]) -> list[str]:
    keys: list[str] = []
    above: list[tuple[int, str]] = []
    for line in lines:
        key = key_of(line)
        if key is None:
            continue
        indent, name = len(key[0]), key[1]
        while above and above[-1][0] >= indent:
            above.pop()
        if name == PARAMETERS:
            keys.append('/'.join(each for _, each in above))
        above.append((indent, name))
    return keys


def key_matches(key: str, name: str, namespace: Optional[str]) -> bool:
    """Return whether a key is for a node; without a namespace it may be in any."""
    if namespace is None:
        last = key.rpartition('/')[2]
        return last in ('*', '**', name)
    pattern = re.escape('/' + key.lstrip('/'))
    pattern = pattern.replace(r'/\*\*', r'(/\w+)*').replace(r'/\*', r'/\w+')
    return re.fullmatch(pattern, f'{namespace.rstrip("/")}/{name}') is not None
