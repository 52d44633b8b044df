# SPDX-License-Identifier: Apache-2.0
"""Determine the effective parameters of a node from its command line."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Optional

from launch.utilities.type_utils import read_yaml
from launch_ros.utilities.parameter_file_check import key_matches
from launch_ros.utilities.parameter_files import is_written_here

_FILE = '--params-file'
_RULE = ('-p', '--param')
_ALL = '/**'


def effective_parameters(
    words: Sequence[str],
    name: Optional[str],
    namespace: Optional[str],
) -> dict[str, Any]:
    """
    Return the effective parameters of a node, by name, from its command line.

    ROS merges entries with the same key at the position of the first one; of the keys that match
    the node, later ones take precedence. Single parameters have the key `/**`.

    Parameters
    ----------
    words
        The command line, with `-p` and `--params-file`; unreadable files are skipped.
    name
        The node name; None matches the wildcards `*` and `**` only.
    namespace
        The absolute namespace; None stands for the root.

    """
    by_key: dict[str, dict[str, Any]] = {}
    for key, parameters in _given(words):
        by_key.setdefault(key, {}).update(parameters)
    result: dict[str, Any] = {}
    for key, parameters in by_key.items():
        if _is_for(key, name, namespace):
            result.update(parameters)
    return dict(sorted(result.items()))


def parameter_files(words: Sequence[str]) -> list[str]:
    """
    Return the parameter files of a command line, except those written for dictionaries.

    Parameters
    ----------
    words
        The command line.

    """
    named = [value for option, value in zip(words, words[1:]) if option == _FILE]
    return [path for path in named if not is_written_here(path)]


def _given(words: Sequence[str]) -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield keys and their parameters, in the order of the command line."""
    for option, value in zip(words, words[1:]):
        if option == _FILE:
            yield from _in_file(value)
        elif option in _RULE and ':=' in value:
            name, _, text = value.partition(':=')
            node, colon, name_in_node = name.rpartition(':')
            yield (node if colon else _ALL), {name_in_node: read_yaml(text)}


def _in_file(path: str) -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield the entries of a file; skip unreadable ones, which the nodes report themselves."""
    import yaml

    try:
        with open(path, encoding='utf-8') as file:
            yield from _in_mapping(yaml.safe_load(file), ())
    except (OSError, UnicodeDecodeError, yaml.YAMLError):
        return


def _in_mapping(value: Any, above: tuple[str, ...]) -> Iterator[tuple[str, dict[str, Any]]]:
    for key, below in value.items() if isinstance(value, Mapping) else ():
        if key == 'ros__parameters':
            yield '/'.join(above), dict(_flat(below, ''))
        else:
            yield from _in_mapping(below, (*above, str(key)))


def _flat(value: Any, prefix: str) -> Iterator[tuple[str, Any]]:
    for key, below in value.items() if isinstance(value, Mapping) else ():
        if isinstance(below, Mapping):
            yield from _flat(below, f'{prefix}{key}.')
        else:
            yield f'{prefix}{key}', below


def _is_for(key: str, name: Optional[str], namespace: Optional[str]) -> bool:
    """Whether a key matches a node; an unknown node name matches wildcards only."""
    if name is None:
        return key.rpartition('/')[2] in ('*', '**')
    return key_matches(key, name, namespace or '/')
