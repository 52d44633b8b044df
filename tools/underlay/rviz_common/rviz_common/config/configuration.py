# SPDX-License-Identifier: Apache-2.0
"""The contents of a .rviz file, by section."""

from __future__ import annotations

from collections.abc import Mapping
import os
import stat
from typing import Any

from rviz_common.config.default import default_values
from rviz_common.config.yaml_file import (
    ConfigError,
    Document,
    Place,
    read_yaml,
    replace_file,
    write_yaml,
)

__all__ = [
    'DISPLAYS',
    'LARGEST',
    'OPTIONS',
    'PANELS',
    'SAVED_VIEWS',
    'TOOLS',
    'TOO_LARGE',
    'VIEW',
    'Configuration',
]

MANAGER: Place = ('Visualization Manager',)
DISPLAYS: Place = (*MANAGER, 'Displays')
OPTIONS: Place = (*MANAGER, 'Global Options')
TOOLS: Place = (*MANAGER, 'Tools')
VIEW: Place = (*MANAGER, 'Views', 'Current')
SAVED_VIEWS: Place = (*MANAGER, 'Views', 'Saved')
PANELS: Place = ('Panels',)
GROUP = 'rviz_common/Group'
LARGEST = 10_000_000
TOO_LARGE = f'The file is larger than {LARGEST // 1_000_000} MB.'


class Configuration:
    """
    The contents of a .rviz file, by section; unknown content is preserved.

    Parameters
    ----------
    document
        The values of the file, and their line numbers.

    Raises
    ------
    ConfigError
        A section or an entry does not have the form of a .rviz file.

    Attributes
    ----------
    displays, saved_views
        The entries of these sections, none without such a section.
    panels, tools
        The entries of these sections, those of the default configuration without such a section.
    options
        The global options.
    view
        The current view.

    """

    def __init__(self, document: Document) -> None:
        self.document = document
        self._has(document.values, dict, ())
        defaults: Any = default_values()
        self.displays = self._entries(DISPLAYS, [])
        self._check_groups(self.displays, DISPLAYS)
        self.panels = self._entries(PANELS, defaults['Panels'])
        self.tools = self._entries(TOOLS, defaults['Visualization Manager']['Tools'])
        self.options: dict[str, Any] = self._find(OPTIONS, dict) or {}
        self.view: dict[str, Any] = self._find(VIEW, dict) or {}
        self.saved_views = self._entries(SAVED_VIEWS, [])
        self._given: dict[Place, Any] = {
            DISPLAYS: self.displays,
            PANELS: self.panels,
            TOOLS: self.tools,
            OPTIONS: self.options,
            VIEW: self.view,
            SAVED_VIEWS: self.saved_views,
        }

    @classmethod
    def default(cls) -> Configuration:
        """Return the configuration used without a file."""
        return cls(Document('the default configuration', default_values()))

    @classmethod
    def read(cls, path: str) -> Configuration:
        """
        Read a .rviz file.

        Parameters
        ----------
        path
            The path of the file, which must be a regular one of at most 10 MB.

        Raises
        ------
        ConfigError
            The file cannot be read, or is not an RViz configuration.

        """
        try:
            text = _text_of(path)
        except OSError as error:
            raise ConfigError(path, None, _unreadable(path, error)) from error
        except UnicodeDecodeError as error:
            raise ConfigError(path, None, f'The file is not a text file: {error}.') from error
        return cls.parse(text, path)

    @classmethod
    def parse(cls, text: str, source: str) -> Configuration:
        """
        Parse the text of a .rviz file.

        Parameters
        ----------
        text
            The YAML.
        source
            The source of the text, for error messages.

        Raises
        ------
        ConfigError
            The text is not YAML, is empty, or does not have the form of a .rviz file.

        """
        document = read_yaml(text, source)
        if document.values is None:
            raise ConfigError(source, None, 'The file is empty, not an RViz configuration.')
        return cls(document)

    def text(self, sections: Mapping[Place, Any]) -> str:
        """
        Format the file with the current sections; unchanged content is preserved.

        Parameters
        ----------
        sections
            The values of sections by place, such as `DISPLAYS`.

        Returns
        -------
        str
            The YAML.

        """
        values = self.document.values
        for place, section in sections.items():
            if section != self._given[place]:
                values = _replaced(values, place, section)
        return write_yaml(values)

    def save(self, path: str, sections: Mapping[Place, Any]) -> None:
        """
        Write the file with the current sections, atomically.

        Parameters
        ----------
        path
            The file to replace.
        sections
            The values of sections by place, such as `DISPLAYS`.

        Raises
        ------
        ConfigError
            The file cannot be written; it is left unchanged.

        """
        replace_file(path, self.text(sections))

    def _entries(self, place: Place, default: list[dict[str, Any]]) -> list[dict[str, Any]]:
        """Return a section that is a list of mappings, or the default if it is missing."""
        found = self._at(place)
        if found is _MISSING:
            return default
        entries: list[dict[str, Any]] = self._has(found, list, place) or []
        for index, entry in enumerate(entries):
            self._has(entry, dict, (*place, index), is_needed=True)
            self._has(entry.get('Class'), str, (*place, index, 'Class'), is_needed=True)
        return entries

    def _check_groups(self, entries: list[dict[str, Any]], place: Place) -> None:
        for index, entry in enumerate(entries):
            if entry['Class'] == GROUP:
                below = (*place, index, 'Displays')
                self._check_groups(self._entries(below, []), below)

    def _find(self, place: Place, kind: type) -> Any:
        found = self._at(place)
        return None if found is _MISSING else self._has(found, kind, place)

    def _at(self, place: Place) -> Any:
        found = self.document.values
        for depth, name in enumerate(place):
            if isinstance(name, str):
                found = self._has(found, dict, place[:depth]) or {}
                if name not in found:
                    return _MISSING
            found = found[name]
        return found

    def _has(self, value: Any, kind: type, place: Place, is_needed: bool = False) -> Any:
        """Return a value if it has the expected type; raise ConfigError otherwise."""
        if isinstance(value, kind) or (value is None and not is_needed):
            return value
        name = place[-1] if place else ''
        subject = f"'{name}'" if isinstance(name, str) and name else 'This'
        if value is None:
            reason = f'{subject} is missing, but must be {KINDS[kind]}.'
        else:
            reason = f'{subject} must be {KINDS[kind]}, not {_shown(value)}.'
        raise ConfigError(self.document.source, self.document.line(place), reason)


KINDS: dict[type, str] = {
    dict: "a mapping (lines like 'Name: value')",
    list: "a list (lines that start with '- ')",
    str: 'a string',
}
_MISSING = object()


def _replaced(values: Any, place: Place, section: Any) -> Any:
    """Return the values with a section replaced; the order is preserved."""
    if not place:
        return section
    name = place[0]
    below = dict(values or {})
    below[str(name)] = _replaced(below.get(str(name)), place[1:], section)
    return below


def _shown(value: Any) -> str:
    return KINDS.get(type(value), f"'{value}'")


def _text_of(path: str) -> str:
    """Read the text of a regular file; a pipe is rejected, as it might never end."""
    with open(path, 'rb', opener=_open_at_once) as file:
        about = os.fstat(file.fileno())
        if not stat.S_ISREG(about.st_mode):
            raise ConfigError(path, None, 'This is not a regular file.')
        if about.st_size > LARGEST:
            raise ConfigError(path, None, TOO_LARGE)
        return file.read(LARGEST + 1).decode('utf-8-sig')


def _open_at_once(path: str, flags: int) -> int:
    return os.open(path, flags | os.O_NONBLOCK)


def _unreadable(path: str, error: OSError) -> str:
    if isinstance(error, FileNotFoundError):
        full = os.path.abspath(path)
        return f'File not found. Looked for {full}.'
    return f'The file cannot be read: {error.strerror}.'
