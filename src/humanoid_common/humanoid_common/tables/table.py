# SPDX-License-Identifier: Apache-2.0
"""Read YAML files, with errors that name the file, the line and the key."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
import math
from pathlib import Path
from typing import Any

from humanoid_common.naming import did_you_mean, shortened
from humanoid_common.tables.source_location import SourceLocation, TableError

Vector = tuple[float, ...]


class Table:
    """
    Names and values of a file, or of a part of it, which are checked when they are read.

    Parameters
    ----------
    values
        The parsed table; for a `LinedTable`, errors also name the lines of the values.
    place
        Location of the table in the file.

    Raises
    ------
    TableError
        The values are not a table.

    """

    def __init__(self, values: Any, place: SourceLocation) -> None:
        if not isinstance(values, Mapping):
            raise place.wrong('a mapping of names to values', values)
        self._values = values
        self._lines: Mapping[str, int] = getattr(values, 'lines', {})
        self.place = place

    @property
    def names(self) -> list[str]:
        """Return the names, in the order of the file."""
        return [str(name) for name in self._values]

    def has(self, name: str) -> bool:
        """
        Check whether a value is set, and not null.

        Parameters
        ----------
        name
            Name of the value.

        """
        return self._values.get(name) is not None

    def allow(self, *names: str) -> None:
        """
        Check that the table sets nothing but known names.

        Parameters
        ----------
        *names
            All names that are allowed in this table.

        Raises
        ------
        TableError
            It sets another one; the message suggests the closest known name.

        """
        for name in self.names:
            if name not in names:
                hint = did_you_mean(name, names) or f'Valid keys: {", ".join(names)}.'
                raise self.at(name).error(f"{self.place.name} has an unknown key '{shortened(name)}'. {hint}")

    def number(
        self,
        name: str,
        default: float | None = None,
        at_least: float = -math.inf,
        at_most: float = math.inf,
    ) -> float:
        """
        Read a finite number, as a float.

        Parameters
        ----------
        name
            Name of the value.
        default
            Value if the table does not set it; None if it is required.
        at_least, at_most
            The limits of the value.

        Raises
        ------
        TableError
            It is missing, or is not such a number.

        """
        if default is not None and name not in self._values:
            return default
        value = self._value(name, default)
        if not _is_number(value) or not at_least <= value <= at_most:
            raise self.at(name).wrong(f'a finite number{_limits(at_least, at_most)}', value)
        return float(value)

    def integer(
        self, name: str, default: int, at_least: float = 0, at_most: float = math.inf
    ) -> int:
        """
        Read a whole number.

        Parameters
        ----------
        name
            Name of the value.
        default
            Value if the table does not set it.
        at_least, at_most
            The limits of the value.

        Raises
        ------
        TableError
            It is not such a number.

        """
        value = self._value(name, default)
        is_whole = isinstance(value, int) and not isinstance(value, bool)
        if not is_whole or not at_least <= value <= at_most:
            raise self.at(name).wrong(f'a whole number{_limits(at_least, at_most)}', value)
        return int(value)

    def vector(self, name: str, length: int, default: Vector | None = None) -> Vector:
        """
        Read a list of finite numbers, as a tuple of floats.

        Parameters
        ----------
        name
            Name of the value.
        length
            How many numbers the list must have.
        default
            Value if the table does not set it; None if it is required.

        Raises
        ------
        TableError
            It is missing, or is not such a list.

        """
        value = self._value(name, default)
        if not is_vector(value, length):
            raise self.at(name).wrong(f'a list of {length} finite numbers', value)
        return tuple(float(number) for number in value)

    def text(self, name: str, default: str | None = None) -> str:
        """
        Read a string; it may be empty only if the default is.

        Parameters
        ----------
        name
            Name of the value.
        default
            Value if the table does not set it; None if it is required.

        Raises
        ------
        TableError
            It is missing, empty, or not a string.

        """
        value = self._value(name, default)
        if not isinstance(value, str) or not (value or default == ''):
            raise self.at(name).wrong('a string', value)
        return value

    def choice(self, name: str, choices: Sequence[str], default: str | None = None) -> str:
        """
        Read a string that must be one of several choices.

        Parameters
        ----------
        name
            Name of the value.
        choices
            The strings that are allowed.
        default
            Value if the table does not set it; None if it is required.

        Raises
        ------
        TableError
            It is missing, or none of these; the message suggests the closest one.

        """
        value = self.text(name, default)
        if value not in choices:
            raise self.at(name).not_among(choices, value)
        return value

    def words(self, name: str) -> tuple[str, ...]:
        """
        Read a list of different strings.

        Parameters
        ----------
        name
            Name of the value.

        Raises
        ------
        TableError
            It is missing, is not a list of at least one string, or has one of them twice.

        """
        values = self._value(name, None)
        if not isinstance(values, list) or not values:
            raise self.at(name).wrong('a list of strings', values)
        for value in values:
            if not isinstance(value, str) or values.count(value) > 1:
                raise self.at(name).wrong('a list of strings, each once', value)
        return tuple(values)

    def value(self, name: str) -> Any:
        """
        Return a value as parsed from the file, unchecked; None if it is not set.

        Parameters
        ----------
        name
            Name of the value.

        """
        return self._values.get(name)

    def table(self, name: str) -> Table:
        """
        Read a nested table; one that is not set is empty.

        Parameters
        ----------
        name
            Name of the nested table.

        Raises
        ------
        TableError
            The value is not a table.

        """
        return Table(self._values.get(name, {}), self.at(name))

    def tables(self, name: str) -> Iterator[Table]:
        """
        Iterate over a list of tables; one that is not set is empty.

        Parameters
        ----------
        name
            Name of the list.

        Yields
        ------
        Table
            Each item, with its own location in the file.

        Raises
        ------
        TableError
            The value is not a list, or an item is not a table.

        """
        values = self._values.get(name, [])
        if not isinstance(values, list):
            raise self.at(name).wrong('a list', values)
        for number, value in enumerate(values):
            yield Table(value, self.at(name).item(number, getattr(value, 'line', 0)))

    def at(self, name: str) -> SourceLocation:
        """
        Locate a value of this table in its file.

        Parameters
        ----------
        name
            Name of the value.

        """
        return self.place.of(name, self._lines.get(name, 0))

    def _value(self, name: str, default: Any) -> Any:
        """Return a value, or the default; raise TableError if there is neither."""
        value = self._values.get(name, default)
        if value is None:
            raise self.place.missing(name)
        return value


def load_table(path: Path) -> Table:
    """
    Load a YAML file as a table.

    Parameters
    ----------
    path
        Path of the file.

    Raises
    ------
    TableError
        It cannot be read, is not YAML in UTF-8, or its top level is not a table.

    """
    try:
        text = path.read_text(encoding='utf-8')
    except OSError as error:
        raise TableError(f'{path} cannot be read: {error.strerror}.') from error
    except UnicodeDecodeError as error:
        raise TableError(f'{path} is not a valid YAML file: {error}') from error
    return table_of(text, str(path))


def table_of(text: str, source: str) -> Table:
    """
    Parse a YAML text as a table.

    Parameters
    ----------
    text
        Content of a file.
    source
        What error messages call it, such as the path of the file.

    Raises
    ------
    TableError
        It is not YAML, or its top level is not a table.

    """
    from humanoid_common.tables.yaml_lines import read_lines
    import yaml

    try:
        content = read_lines(text)
    except (yaml.YAMLError, RecursionError) as error:
        raise TableError(f'{source} is not a valid YAML file: {error}') from error
    return Table(content, SourceLocation(source, 1))


def _limits(at_least: float, at_most: float) -> str:
    """Format the limits of a number, for after the word."""
    if at_most < math.inf:
        return f' from {at_least:g} to {at_most:g}'
    if at_least > -math.inf:
        return f' of at least {at_least:g}'
    return ''


def _is_number(value: Any) -> bool:
    """Check whether a value is a finite number."""
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    return is_number and math.isfinite(value)


def is_vector(value: Any, length: int) -> bool:
    """
    Check whether a value is a list of finite numbers.

    Parameters
    ----------
    value
        The value.
    length
        How many numbers the list must have.

    """
    return (
        isinstance(value, Sequence)
        and not isinstance(value, str)
        and len(value) == length
        and all(map(_is_number, value))
    )
