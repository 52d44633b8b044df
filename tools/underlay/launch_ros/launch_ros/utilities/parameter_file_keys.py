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

    Only the lines are looked at, because reading large files as YAML takes long; a file that is
    not in block style has no names here.

    Parameters
    ----------
    path
        The file; one that cannot be read has no names.

    """
    return _keys(read_lines(path))


def read_lines(path: str) -> list[str]:
    """
    Return the lines of a text file, none if it cannot be read.

    Parameters
    ----------
    path
        The file, in UTF-8.

    """
    try:
        with open(path, encoding='utf-8') as file:
            return file.read().splitlines()
    except (OSError, UnicodeDecodeError):
        return []


def key_of(line: str) -> Optional[tuple[str, str]]:
    """
    Split the key off a line of YAML in block style.

    Parameters
    ----------
    line
        One line, without its end.

    Returns
    -------
    tuple of str or None
        The spaces before the key, and the key without quotes; None if the line begins with none.

    """
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
    """
    Whether a key of a parameter file stands for a node.

    Parameters
    ----------
    key
        The name of a node, perhaps with the wildcards `*` and `**`.
    name
        The node name.
    namespace
        The absolute namespace; None if it is not known, so that the key may be for any.

    """
    if namespace is None:
        last = key.rpartition('/')[2]
        return last in ('*', '**', name)
    pattern = re.escape('/' + key.lstrip('/'))
    pattern = pattern.replace(r'/\*\*', r'(/\w+)*').replace(r'/\*', r'/\w+')
    return re.fullmatch(pattern, f'{namespace.rstrip("/")}/{name}') is not None
