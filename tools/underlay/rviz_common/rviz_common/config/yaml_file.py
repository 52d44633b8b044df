# SPDX-License-Identifier: Apache-2.0
"""How the YAML of a .rviz file is read, with the line of each value and error, and written."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, field
import os
import re
import stat
import tempfile
from typing import Any

import yaml

__all__ = [
    'ConfigError',
    'Document',
    'Place',
    'read_yaml',
    'replace_file',
    'scalar_value',
    'write_yaml',
]

Place = tuple['str | int', ...]
"""The keys and indices that lead to a value."""

MAXIMAL_DEPTH = 60
MAXIMAL_COUNT = 500_000

WHOLE = re.compile(r'[-+]?(0|[1-9][0-9]*)')
NUMBER = re.compile(r'[-+]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][-+]?[0-9]+)?')
LEADING_ZERO = re.compile(r'[-+]?0[0-9]+')
WORDS = {'': None, '~': None, 'null': None, 'true': True, 'false': False}
Loader = getattr(yaml, 'CBaseLoader', yaml.BaseLoader)


class ConfigError(ValueError):
    """
    A file that cannot be read or written, with the place and the reason.

    Parameters
    ----------
    source
        The file, or another source of the text.
    line
        The line of the error, counted from 1; None if it concerns the whole file.
    reason
        What is wrong, as a message for the user.

    """

    def __init__(self, source: str, line: int | None, reason: str) -> None:
        self.source = source
        self.line = line
        self.reason = reason
        place = source if line is None else f'{source}:{line}'
        super().__init__(f'{place}: {reason}')


@dataclass(frozen=True)
class Document:
    """The values of a YAML file, and their line numbers."""

    source: str
    values: Any
    lines: dict[Place, int] = field(default_factory=dict)

    def line(self, place: Place) -> int | None:
        """
        Find the line of a value, or else that of the nearest enclosing value.

        Parameters
        ----------
        place
            The keys and indices that lead to the value.

        Returns
        -------
        int | None
            The line, counted from 1; None if there are no lines, as for the default configuration.

        """
        for length in range(len(place), -1, -1):
            if place[:length] in self.lines:
                return self.lines[place[:length]]
        return None

    def where(self, place: Place) -> str:
        """
        Format the file and the line of a value, as `FILE:LINE`.

        Parameters
        ----------
        place
            The keys and indices that lead to the value.

        """
        line = self.line(place)
        return self.source if line is None else f'{self.source}:{line}'


def read_yaml(text: str, source: str) -> Document:
    """
    Parse YAML, recording the line of each value.

    Parameters
    ----------
    text
        A single YAML document, without aliases or duplicate keys.
    source
        The source of the text, for error messages.

    Returns
    -------
    Document
        Mappings, lists and scalars; the values are None for an empty text.

    Raises
    ------
    ConfigError
        The text cannot be parsed, is nested too deeply, or is too large.

    """
    reader = _Reader(text, source)
    try:
        return Document(source, reader.document(), reader.lines)
    except yaml.MarkedYAMLError as error:
        raise _unreadable(error, text, source) from error
    except yaml.YAMLError as error:
        said = ' '.join(str(error).split())
        raise ConfigError(source, None, f'This is not YAML: {said}.') from error


def scalar_value(text: str) -> Any:
    """
    Convert an unquoted scalar: null, true, false and numbers; anything else stays a string.

    Parameters
    ----------
    text
        The scalar, as written in the file.

    """
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
    """Builds values from the parser events of a file, and records their lines."""

    def __init__(self, text: str, source: str) -> None:
        self.lines: dict[Place, int] = {}
        self._events: Iterator[Any] = yaml.parse(text, Loader=Loader)
        self._source = source
        self._count = 0

    def document(self) -> Any:
        """Return the value of the first document, which must be the only one."""
        next(self._events)
        if isinstance(next(self._events), yaml.StreamEndEvent):
            return None
        value = self._value(next(self._events), ())
        next(self._events)
        more = next(self._events)
        if not isinstance(more, yaml.StreamEndEvent):
            raise ConfigError(self._source, _line(more), 'A second document starts here.')
        return value

    def _value(self, event: Any, place: Place) -> Any:
        """Return the value that starts with an event."""
        line = self.lines[place] = _line(event)
        self._count += 1
        if len(place) > MAXIMAL_DEPTH or self._count > MAXIMAL_COUNT:
            raise ConfigError(self._source, line, 'The file is nested too deeply, or too large.')
        if isinstance(event, yaml.MappingStartEvent):
            return self._mapping(place)
        if isinstance(event, yaml.SequenceStartEvent):
            return self._sequence(place)
        return self._scalar(event)

    def _scalar(self, event: Any) -> Any:
        if isinstance(event, yaml.AliasEvent):
            reason = f"Alias '*{event.anchor}' is not supported: write the value itself here."
            raise ConfigError(self._source, _line(event), reason)
        return event.value if event.style else scalar_value(event.value)

    def _sequence(self, place: Place) -> list[Any]:
        values: list[Any] = []
        while not isinstance(event := next(self._events), yaml.SequenceEndEvent):
            values.append(self._value(event, (*place, len(values))))
        return values

    def _mapping(self, place: Place) -> dict[str, Any]:
        values: dict[str, Any] = {}
        while not isinstance(key := next(self._events), yaml.MappingEndEvent):
            if not isinstance(key, yaml.ScalarEvent):
                raise ConfigError(
                    self._source, _line(key), 'A key must be a string, not a mapping or a list.'
                )
            name, here = key.value, (*place, key.value)
            if name in values:
                self._refuse_second(name, _line(key), self.lines[here])
            values[name] = self._value(next(self._events), here)
            self.lines[here] = _line(key)
        return values

    def _refuse_second(self, name: str, line: int, first: int) -> None:
        raise ConfigError(
            self._source,
            line,
            f"'{name}' is already in line {first}: remove one of the two.",
        )


def _line(event: Any) -> int:
    return int(event.start_mark.line + 1)


def _unreadable(error: yaml.MarkedYAMLError, text: str, source: str) -> ConfigError:
    """Return the error for unreadable text, with its line."""
    mark = error.problem_mark or error.context_mark
    if mark is None:
        return ConfigError(source, None, f'This is not YAML: {error}.')
    lines = text.splitlines()
    if mark.line < len(lines) and lines[mark.line].startswith('\t', mark.column):
        return ConfigError(source, mark.line + 1, 'There is a tab. Indent with spaces only.')
    said = ', '.join(each for each in (error.context, error.problem) if each)
    return ConfigError(source, mark.line + 1, f'This is not YAML: {said}.')


def write_yaml(values: Any) -> str:
    """
    Format values as YAML in the style of RViz.

    Parameters
    ----------
    values
        Nested dicts and lists of scalars.

    """
    text: str = yaml.dump(
        values,
        Dumper=_Dumper,
        default_flow_style=False,
        sort_keys=False,
        allow_unicode=True,
        width=1_000_000,
    )
    return text


class _Dumper(yaml.SafeDumper):
    """Indents lists as RViz does; all scalars are strings, some of them unquoted."""

    yaml_implicit_resolvers: dict[Any, Any] = {}

    def increase_indent(self, flow: bool = False, indentless: bool = False) -> None:
        """Indent lists below their keys, too."""
        super().increase_indent(flow, False)

    def ignore_aliases(self, data: Any) -> bool:
        """Write repeated values in full, without aliases."""
        return True


def _scalar(dumper: yaml.SafeDumper, text: str, style: str | None = None) -> yaml.Node:
    return dumper.represent_scalar('tag:yaml.org,2002:str', text, style)


def _text(dumper: yaml.SafeDumper, text: str) -> yaml.Node:
    """Quote strings that would be read as another type."""
    return _scalar(dumper, text, None if isinstance(scalar_value(text), str) else '"')


_Dumper.add_representer(str, _text)
_Dumper.add_representer(bool, lambda dumper, value: _scalar(dumper, str(value).lower()))
_Dumper.add_representer(int, lambda dumper, value: _scalar(dumper, str(value)))
_Dumper.add_representer(float, lambda dumper, value: _scalar(dumper, repr(value)))
_Dumper.add_representer(type(None), lambda dumper, value: _scalar(dumper, '~'))


def replace_file(path: str, text: str) -> None:
    """
    Replace the contents of a file atomically, preserving its permissions.

    Parameters
    ----------
    path
        The file. If it is a symbolic link, its target is replaced.
    text
        The new contents, written as UTF-8.

    Raises
    ------
    ConfigError
        The file cannot be written; it is left unchanged.

    """
    path = os.path.realpath(path)  # the target of a link, not the link itself
    try:
        _replace(path, text.encode())
    except OSError as error:
        raise ConfigError(
            path, None, f'The file cannot be written: {error.strerror}. It is unchanged.'
        ) from error


def _replace(path: str, content: bytes) -> None:
    directory, name = os.path.split(path)
    handle, temporary = tempfile.mkstemp(prefix=f'.{name}.', dir=directory)
    try:
        with open(handle, 'wb') as file:
            os.fchmod(handle, _mode(path))
            file.write(content)
            file.flush()
            os.fsync(handle)
        os.replace(temporary, path)
    except BaseException:
        with suppress(OSError):
            os.unlink(temporary)
        raise


def _mode(path: str) -> int:
    """Return the permissions of the existing file, or those of a new one."""
    with suppress(OSError):
        return stat.S_IMODE(os.stat(path).st_mode)
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask
