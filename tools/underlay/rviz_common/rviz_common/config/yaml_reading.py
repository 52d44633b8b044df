# SPDX-License-Identifier: Apache-2.0
"""
Read YAML as RViz writes it.

RViz takes all scalars for texts, and asks what they mean only where they are used. So only what
is written back the same is made a number here: `007` and `on` remain texts, `1e-05` is a number.
"""

from __future__ import annotations

import re
from typing import Any

from rviz_common.config.config_error import ConfigError
from rviz_common.config.document import Document, Place
import yaml

__all__ = ['read_yaml', 'scalar_value']

MAXIMAL_DEPTH = 60
MAXIMAL_COUNT = 500_000

WHOLE = re.compile(r'[-+]?(0|[1-9][0-9]*)')
NUMBER = re.compile(r'[-+]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][-+]?[0-9]+)?')
LEADING_ZERO = re.compile(r'[-+]?0[0-9]+')
WORDS = {'': None, '~': None, 'null': None, 'true': True, 'false': False}
Loader = getattr(yaml, 'CBaseLoader', yaml.BaseLoader)


def read_yaml(text: str, source: str) -> Document:
    """Return the values of a text, or raise ConfigError."""
    try:
        node = yaml.compose(text, Loader=Loader)
    except yaml.MarkedYAMLError as error:
        raise _unreadable(error, text, source) from error
    except yaml.YAMLError as error:
        raise ConfigError(source, None, f'This is not YAML: {error}.') from error
    reader = _Reader(source)
    values = None if node is None else reader.value(node, ())
    return Document(source, values, reader.lines)


def scalar_value(text: str) -> Any:
    """Return what a text without quotes means."""
    if text.lower() in WORDS:
        return WORDS[text.lower()]
    if LEADING_ZERO.match(text):
        return text
    if WHOLE.fullmatch(text):
        return int(text) if len(text) < 300 else text
    if NUMBER.fullmatch(text):
        number = float(text)
        return number if abs(number) != float('inf') else text
    return text


class _Reader:
    """Makes values of the nodes of a file, and remembers their lines."""

    def __init__(self, source: str) -> None:
        self.lines: dict[Place, int] = {}
        self._source = source
        self._count = 0

    def value(self, node: yaml.Node, place: Place) -> Any:
        """Return the value of a node."""
        line = self.lines[place] = node.start_mark.line + 1
        self._count += 1
        if len(place) > MAXIMAL_DEPTH or self._count > MAXIMAL_COUNT:
            raise ConfigError(self._source, line, 'The file is nested too deeply, or too large.')
        if isinstance(node, yaml.MappingNode):
            return self._mapping(node, place)
        if isinstance(node, yaml.SequenceNode):
            return [self.value(each, (*place, index)) for index, each in enumerate(node.value)]
        is_quoted = bool(getattr(node, 'style', None))
        return node.value if is_quoted else scalar_value(node.value)

    def _mapping(self, node: yaml.MappingNode, place: Place) -> dict[str, Any]:
        values: dict[str, Any] = {}
        for key, below in node.value:
            name, line = key.value, key.start_mark.line + 1
            here = (*place, name)
            if not isinstance(key, yaml.ScalarNode):
                raise ConfigError(self._source, line, 'A key must be a text, and not a tree.')
            if name in values:
                first = self.lines[here]
                raise ConfigError(
                    self._source,
                    line,
                    f"'{name}' stands here and in line {first} already: remove one of them.",
                )
            values[name] = self.value(below, here)
            self.lines[here] = line
        return values


def _unreadable(error: yaml.MarkedYAMLError, text: str, source: str) -> ConfigError:
    """Say what cannot be read, and where."""
    mark = error.problem_mark or error.context_mark
    if mark is None:
        return ConfigError(source, None, f'This is not YAML: {error}.')
    lines = text.splitlines()
    if mark.line < len(lines) and lines[mark.line][mark.column :].startswith('\t'):
        return ConfigError(source, mark.line + 1, 'There is a tab. Indent with spaces only.')
    said = ', '.join(each for each in (error.context, error.problem) if each)
    return ConfigError(source, mark.line + 1, f'This is not YAML: {said}.')
