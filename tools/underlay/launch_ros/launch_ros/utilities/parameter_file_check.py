# SPDX-License-Identifier: Apache-2.0
"""
Check parameter files, without parsing all of them as YAML.

A file has no effect if it is invalid or if its node names match no launched node.
"""

from __future__ import annotations

from collections.abc import Sequence
import re
from typing import NamedTuple, Optional, TYPE_CHECKING

from launch.launch_context import LaunchContext
from launch.logging import get_logger
from launch_ros.utilities.node_names import get_node_names

if TYPE_CHECKING:
    from launch_ros.utilities.node_names import NodeNames

_FullName = tuple[str, Optional[str]]

_KEY = re.compile(
    r"""^( *)(?:"([^"]*)"|'([^']*)'|([^\s#"'{\[&*!|>%@`?-][^#]*?|/[^#]*?|\*\*)) *:(?:\s|$)"""
)
_PARAMETERS = 'ros__parameters'


class ParameterFilesCheck:
    """Checks that parameter files match at least one launched node."""

    def __init__(self) -> None:
        """Create a check without files."""
        self._readers: dict[str, list[NodeNames]] = {}

    def add(self, path: str, names: NodeNames) -> None:
        """
        Register a parameter file of a node.

        Parameters
        ----------
        path
            The file.
        names
            The name and the namespace of the node, as far as known.

        """
        self._readers.setdefault(path, []).append(names)

    def __call__(self, context: LaunchContext) -> None:
        """Log a warning for each file that is invalid or matches no known node."""
        for path in self._readers:
            _warn_of_problem(path)
        nodes = self._known_nodes(context)
        for path, readers in self._readers.items():
            if nodes is None or any(names.name is None for names in readers):
                continue
            keys = parameter_file_keys(path)
            if keys and not any(key_matches(key, *node) for key in keys for node in nodes):
                _warn(path, keys, nodes)

    def _known_nodes(self, context: LaunchContext) -> Optional[set[_FullName]]:
        """Return the nodes launched now or later; None if that cannot be determined."""
        nodes = {
            (names.name, names.namespace)
            for readers in self._readers.values()
            for names in readers
            if names.name is not None
        }
        for full_name in get_node_names(context):
            namespace, _, name = full_name.rpartition('/')
            nodes.add((name, namespace or '/'))
        later = _names_of_waiting_nodes(context)
        return None if later is None else nodes | later


def _names_of_waiting_nodes(context: LaunchContext) -> Optional[set[_FullName]]:
    from launch.preflight import constant_text, waiting_entities
    from launch_ros.actions.node import Node

    found: set[_FullName] = set()
    for entity in waiting_entities(context):
        if isinstance(entity, Node):
            name = entity.name_parts and constant_text(entity.name_parts, context)
            if not name:
                return None
            found.add((name, None))
    return found


def _warn_of_problem(path: str) -> None:
    problem = parameter_file_problem(path)
    if problem is not None:
        get_logger('launch_ros.actions.node').warning(
            "the parameter file '%s' cannot be used: line %d, %s", path, *problem
        )


def _warn(path: str, keys: list[str], nodes: set[_FullName]) -> None:
    names = sorted(f'{(namespace or "").rstrip("/")}/{name}' for name, namespace in nodes)
    get_logger('launch_ros.actions.node').warning(
        "the parameter file '%s' is for %s, but the nodes that are launched are %s: it has no "
        'effect',
        path,
        ', '.join(f"'{key}'" for key in dict.fromkeys(keys)),
        ', '.join(f"'{name}'" for name in names),
    )


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
    return _keys(_read_lines(path))


def _read_lines(path: str) -> list[str]:
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


def _key_of(line: str) -> Optional[tuple[str, str]]:
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
        key = _key_of(line)
        if key is None:
            continue
        indent, name = len(key[0]), key[1]
        while above and above[-1][0] >= indent:
            above.pop()
        if name == _PARAMETERS:
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


class _ParameterFileProblem(NamedTuple):
    """A line number and a description of the problem."""

    line: int
    text: str


def parameter_file_problem(path: str) -> Optional[_ParameterFileProblem]:
    """
    Return the first problem of a parameter file in block style; None if there is none.

    Problems are tabs where YAML allows only spaces, and nodes without `ros__parameters`.

    Parameters
    ----------
    path
        The file; no problem is reported if it cannot be read.

    """
    lines = _read_lines(path)
    return _tab(lines) or _entry_without_parameters(lines)


def _tab(lines: Sequence[str]) -> Optional[_ParameterFileProblem]:
    """Return the first tab that YAML rejects; the YAML parser decides where tabs are valid."""
    if not any('\t' in line[: len(line) - len(line.lstrip())] for line in lines):
        return None
    import yaml

    try:
        yaml.compose('\n'.join(lines), yaml.SafeLoader)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark
        if mark is not None and '\t' in lines[min(mark.line, len(lines) - 1)]:
            return _ParameterFileProblem(
                mark.line + 1, 'it is not YAML, which allows only spaces before a name: no tabs'
            )
    return None


def _entry_without_parameters(lines: Sequence[str]) -> Optional[_ParameterFileProblem]:
    """Return the first top-level name with content but without `ros__parameters`."""
    starts = [number for number, line in enumerate(lines) if (_key_of(line) or ' ')[0] == '']
    for start, end in zip(starts, [*starts[1:], len(lines)]):
        block = lines[start:end]
        below = [key[1] for key in map(_key_of, block[1:]) if key is not None]
        text = '\n'.join(block)
        if below and _PARAMETERS not in text and '*' not in ''.join(block[1:]):
            key = _key_of(lines[start])
            return _ParameterFileProblem(start + 1, _missing(key[1] if key else '', below))
    return None


def _missing(name: str, below: Sequence[str]) -> str:
    from ros_environment.suggestions import did_you_mean

    similar = next((each for each in below if did_you_mean(each, [_PARAMETERS])), None)
    text = f"below '{name}' there is no '{_PARAMETERS}'"
    if similar is None:
        return f'{text}, below which the parameters belong'
    return f"{text}: is '{similar}' a misspelling of it?"
