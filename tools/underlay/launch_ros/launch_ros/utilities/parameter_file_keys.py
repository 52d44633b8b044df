# SPDX-License-Identifier: Apache-2.0
"""Which nodes a parameter file is for."""

from __future__ import annotations

import re
from typing import Optional

_KEY = re.compile(
    r"""^( *)(?:"([^"]*)"|'([^']*)'|([^\s#"'{\[&*!|>%@`?-][^#]*?|/[^#]*?|\*\*)) *:(?:\s|$)"""
)
_PARAMETERS = 'ros__parameters'


def parameter_file_keys(path: str) -> list[str]:
    """
    Return the names of nodes in a parameter file, with their wildcards.

    Only the lines are looked at, because reading large files as YAML takes long; a file that
    is not in block style has no names here.
    """
    try:
        with open(path, encoding='utf-8') as file:
            lines = file.read().splitlines()
    except (OSError, UnicodeDecodeError):
        return []
    return _keys(lines)


def _keys(lines: list[str]) -> list[str]:
    keys: list[str] = []
    above: list[tuple[int, str]] = []
    for line in lines:
        match = _KEY.match(line)
        if match is None:
            continue
        indent = len(match[1])
        while above and above[-1][0] >= indent:
            above.pop()
        name = next(each for each in match.groups()[1:] if each is not None)
        if name == _PARAMETERS:
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
