# SPDX-License-Identifier: Apache-2.0
"""Read YAML files so that every mistake becomes a sentence with the file, the line and the key."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
import math
from pathlib import Path
from typing import Any, TypeVar

from humanoid_common.naming import did_you_mean
from humanoid_simulation.errors import SimulationError

T = TypeVar('T')


@dataclass(frozen=True)
class Place:
    """Where something stands in a file; line 0 is not known."""

    file: str
    line: int = 0
    key: str = ''
    """The way to it: `things[0].size`; empty is the whole file."""

    def of(self, key: str, line: int) -> Place:
        """Return the place of a value inside of this one."""
        return Place(self.file, line or self.line, f'{self.key}.{key}' if self.key else key)

    def item(self, number: int, line: int) -> Place:
        """Return the place of an item of this list."""
        return Place(self.file, line or self.line, f'{self.key}[{number}]')

    def error(self, sentence: str) -> TableError:
        """Return the error that says what is wrong here."""
        where = f'{self.file}, line {self.line}' if self.line else self.file
        return TableError(f'{where}: {sentence}')


class TableError(SimulationError):
    """A mistake in a file, with its place."""


class Table:
    """Names and values of a file, or of a part of it."""

    def __init__(self, values: Any, place: Place) -> None:
        """Take what a file holds; `place` is where that stands."""
        if not isinstance(values, Mapping):
            what = place.key or 'the file'
            raise place.error(f'{what} must be a table of names and values, but is {values!r}.')
        self._values = values
        self._lines: Mapping[str, int] = getattr(values, 'lines', {})
        self.place = place

    @property
    def names(self) -> list[str]:
        """Return the names, in the order of the file."""
        return [str(name) for name in self._values]

    def has(self, name: str) -> bool:
        """Tell whether a value is set."""
        return self._values.get(name) is not None

    def allow(self, *names: str) -> None:
        """Refuse a name that means nothing here."""
        for name in self.names:
            if name not in names:
                hint = did_you_mean(name, names) or f'What can be set: {", ".join(names)}.'
                raise self.at(name).error(
                    f"{self.place.key or 'the file'} sets '{name}', which means nothing. {hint}"
                )

    def number(self, name: str, default: float | None = None) -> float:
        """Return a finite number."""
        value = self._value(name, default)
        if not _is_number(value):
            raise self._wrong(name, 'a finite number', value)
        return float(value)

    def integer(self, name: str, default: int) -> int:
        """Return a number that counts."""
        value = self._value(name, default)
        if isinstance(value, bool) or not isinstance(value, int) or value < 0:
            raise self._wrong(name, 'a whole number, not negative', value)
        return value

    def vector(
        self, name: str, length: int, default: Sequence[float] | None = None
    ) -> tuple[float, ...]:
        """Return a list of so many finite numbers."""
        value = self._value(name, default)
        if not _is_vector(value, length):
            raise self._wrong(name, f'a list of {length} finite numbers', value)
        return tuple(float(number) for number in value)

    def vectors(self, name: str, length: int, least: int) -> tuple[tuple[float, ...], ...]:
        """Return a list of at least so many lists of finite numbers."""
        values = self._value(name, None)
        if (
            not isinstance(values, list)
            or len(values) < least
            or not all(_is_vector(value, length) for value in values)
        ):
            raise self._wrong(name, f'a list of {least} or more [x, y]', values)
        return tuple(tuple(float(number) for number in value) for value in values)

    def text(self, name: str, default: str | None = None) -> str:
        """Return a text."""
        value = self._value(name, default)
        if not isinstance(value, str) or not (value or default == ''):
            raise self._wrong(name, 'a text', value)
        return value

    def choice(self, name: str, choices: Sequence[str], default: str | None = None) -> str:
        """Return one of the texts that can be chosen."""
        value = self.text(name, default)
        if value not in choices:
            hint = did_you_mean(value, choices)
            raise self.at(name).error(
                f'{self.at(name).key} must be one of {", ".join(choices)}, '
                f"but is '{value}'. {hint}".rstrip()
            )
        return value

    def value(self, name: str) -> Any:
        """Return a value as it stands in the file, or None."""
        return self._values.get(name)

    def table(self, name: str) -> Table:
        """Return a table within this one; one that is not there is empty."""
        return Table(self._values.get(name, {}), self.at(name))

    def tables(self, name: str) -> Iterator[Table]:
        """Yield the tables of a list, which need not be there."""
        values = self._values.get(name, [])
        if not isinstance(values, list):
            raise self._wrong(name, 'a list', values)
        for number, value in enumerate(values):
            line = getattr(value, 'line', 0)
            yield Table(value, self.at(name).item(number, line))

    def at(self, name: str) -> Place:
        """Return where a value stands."""
        return self.place.of(name, self._lines.get(name, 0))

    def checked(self, make: Callable[[], T]) -> T:
        """Return what is made of this table; what is refused gets the place of the table."""
        try:
            return make()
        except TableError:
            raise
        except SimulationError as error:
            raise self.place.error(str(error)) from error

    def _value(self, name: str, default: Any) -> Any:
        """Return a value, or the default; if there is neither, say so."""
        value = self._values.get(name, default)
        if value is None:
            raise self.place.error(
                f"{self.place.key or 'the file'} does not set '{name}', which is needed."
            )
        return value

    def _wrong(self, name: str, wanted: str, value: Any) -> TableError:
        """Return the error about a value of the wrong kind."""
        return self.at(name).error(f'{self.at(name).key} must be {wanted}, but is {value!r}.')


def load_table(path: Path) -> Table:
    """Read a YAML file."""
    try:
        text = path.read_text(encoding='utf-8')
    except OSError as error:
        raise SimulationError(f'{path} cannot be read: {error.strerror}.') from error
    except UnicodeDecodeError as error:
        raise TableError(f'{path} is no YAML file: {error}') from error
    return table_of(text, str(path))


def table_of(text: str, source: str) -> Table:
    """Read a YAML text; error messages call it by its source."""
    from humanoid_simulation.yaml_lines import read_lines
    import yaml

    try:
        content = read_lines(text)
    except (yaml.YAMLError, RecursionError) as error:
        raise TableError(f'{source} is no YAML file: {error}') from error
    return Table(content, Place(source, 1))


def _is_number(value: Any) -> bool:
    """Tell whether a value is a finite number."""
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    return is_number and math.isfinite(value)


def _is_vector(value: Any, length: int) -> bool:
    """Tell whether a value is a list of so many finite numbers."""
    return (
        isinstance(value, Sequence)
        and not isinstance(value, str)
        and len(value) == length
        and all(map(_is_number, value))
    )
