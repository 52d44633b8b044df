# SPDX-License-Identifier: Apache-2.0
"""Extract the node names of parameter files."""

from __future__ import annotations

import re
from typing import Optional

_KEY = re.compile(
    r"""^( *)(?:"([^"]*)"|'([^']*)'|([^\s#"'{\[&*!|>%@`?-][^#]*?|/[^#]*?|\*\*)) *:(?:\s|$)"""
)
PARAMETERS = 'ros__parameters'


def parameter_file_keys(path: str) -> list[str]:
    """
    Return the node names in a parameter file, including wildcards.

    The file is scanned line by line, as parsing large files as YAML is slow; no names are found
    in files that are not in block style.

    Parameters
    ----------
    path
        The file; no names are found if it cannot be read.

    """
    return _keys(read_lines(path))


def read_lines(path: str) -> list[str]:
    """
    Return the lines of a text file; an empty list if it cannot be read.

    Parameters
    ----------
    path
        The file, encoded in UTF-8.

    """
    try:
        with open(path, encoding='utf-8') as file:
            return file.read().splitlines()
    except (OSError, UnicodeDecodeError):
        return []


def key_of(line: str) -> Optional[tuple[str, str]]:
    """
    Parse the key of a line of YAML in block style.

    Parameters
    ----------
    line
        One line, without the line break.

    Returns
    -------
    tuple of str or None
        The indentation and the unquoted key; None if the line does not start with a key.

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
    Whether a key of a parameter file matches a node.

    Parameters
    ----------
    key
        A node name, possibly with the wildcards `*` and `**`.
    name
        The node name.
    namespace
        The absolute namespace; None if unknown, which matches any namespace.

    """
    if namespace is None:
        last = key.rpartition('/')[2]
        return last in ('*', '**', name)
    pattern = re.escape('/' + key.lstrip('/'))
    pattern = pattern.replace(r'/\*\*', r'(/\w+)*').replace(r'/\*', r'/\w+')
    return re.fullmatch(pattern, f'{namespace.rstrip("/")}/{name}') is not None
