# SPDX-License-Identifier: Apache-2.0
"""Read YAML files so that every mistake becomes a sentence with the file and the key."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
import math
from pathlib import Path
from typing import Any

from humanoid_common.naming import did_you_mean
from humanoid_simulation.errors import SimulationError


class Table:
    """Names and values of a file, or of a part of it."""

    def __init__(self, values: Any, where: str) -> None:
        """Take what a file holds; `where` is what messages call it."""
        if not isinstance(values, Mapping):
            raise SimulationError(
                f'{where} must be a table of names and values, but is {values!r}.'
            )
        self._values = values
        self._where = where

    @property
    def names(self) -> list[str]:
        """Return the names, in the order of the file."""
        return [str(name) for name in self._values]

    def allow(self, *names: str) -> None:
        """Refuse a name that means nothing here."""
        for name in self.names:
            if name not in names:
                hint = did_you_mean(name, names) or f'What can be set: {", ".join(names)}.'
                raise SimulationError(f"{self._where} sets '{name}', which means nothing. {hint}")

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
        if (
            not isinstance(value, Sequence)
            or isinstance(value, str)
            or len(value) != length
            or not all(map(_is_number, value))
        ):
            raise self._wrong(name, f'a list of {length} finite numbers', value)
        return tuple(float(number) for number in value)

    def text(self, name: str) -> str:
        """Return a text."""
        value = self._value(name, None)
        if not isinstance(value, str) or not value:
            raise self._wrong(name, 'a text', value)
        return value

    def choice(self, name: str, choices: Sequence[str]) -> str:
        """Return one of the texts that can be chosen."""
        value = self.text(name)
        if value not in choices:
            hint = did_you_mean(value, choices)
            raise SimulationError(
                f"{self._key(name)} must be one of {', '.join(choices)}, but is '{value}'. {hint}"
            )
        return value

    def table(self, name: str) -> Table:
        """Return a table within this one; one that is not there is empty."""
        return Table(self._values.get(name, {}), self._key(name))

    def tables(self, name: str) -> Iterator[Table]:
        """Yield the tables of a list, which need not be there."""
        values = self._values.get(name, [])
        if not isinstance(values, list):
            raise self._wrong(name, 'a list', values)
        for number, value in enumerate(values):
            yield Table(value, f'{self._key(name)}[{number}]')

    def _value(self, name: str, default: Any) -> Any:
        """Return a value, or the default; if there is neither, say so."""
        value = self._values.get(name, default)
        if value is None:
            raise SimulationError(f"{self._where} does not set '{name}', which is needed.")
        return value

    def _key(self, name: str) -> str:
        """Return what messages call a value."""
        return f'{self._where}{"." if ": " in self._where else ": "}{name}'

    def _wrong(self, name: str, wanted: str, value: Any) -> SimulationError:
        """Return the error about a value of the wrong kind."""
        return SimulationError(f'{self._key(name)} must be {wanted}, but is {value!r}.')


def load_table(path: Path) -> Table:
    """Read a YAML file."""
    import yaml

    try:
        content = yaml.safe_load(path.read_text(encoding='utf-8'))
    except OSError as error:
        raise SimulationError(f'{path} cannot be read: {error.strerror}.') from error
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise SimulationError(f'{path} is no YAML file: {error}') from error
    return Table(content, str(path))


def _is_number(value: Any) -> bool:
    """Tell whether a value is a finite number."""
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    return is_number and math.isfinite(value)
