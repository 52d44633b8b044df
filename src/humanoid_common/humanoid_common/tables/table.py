# SPDX-License-Identifier: Apache-2.0
"""Names and values of a YAML file, checked when they are read."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
import math
import sys
from typing import Any

from humanoid_common.naming import did_you_mean, shortened
from humanoid_common.tables.source_location import SourceLocation

Vector = tuple[float, ...]
Limits = tuple[float, float]
_LARGEST = int(sys.float_info.max)
ANY: Limits = (-math.inf, math.inf)


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
        self._values = {str(name): value for name, value in values.items()}
        self._lines: Mapping[str, int] = getattr(values, 'lines', {})
        self.place = place

    @property
    def names(self) -> list[str]:
        """Return the names, in the order of the file."""
        return [*self._values]

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
        for name in map(shortened, self.names):
            if name not in names:
                hint = did_you_mean(name, names) or f'Valid keys: {", ".join(names)}.'
                raise self.at(name).error(f"{self.place.name} has an unknown key '{name}'. {hint}")

    def number(self, name: str, default: float | None = None, limits: Limits = ANY) -> float:
        """
        Read a finite number, as a float.

        Parameters
        ----------
        name
            Name of the value.
        default
            Value if the table does not set it; None if it is required.
        limits
            The least and the largest value that are allowed.

        Raises
        ------
        TableError
            It is missing, or is not such a number.

        """
        value = self._value(name, default)
        if not _is_finite(value) or not limits[0] <= value <= limits[1]:
            raise self.at(name).wrong(f'a finite number{_said(limits)}', value)
        return float(value)

    def integer(self, name: str, default: int, limits: Limits = (0, math.inf)) -> int:
        """
        Read a whole number.

        Parameters
        ----------
        name, default, limits
            As for `number`.

        Raises
        ------
        TableError
            It is not such a number.

        """
        value = self._value(name, default)
        if type(value) is not int or not limits[0] <= value <= limits[1]:
            raise self.at(name).wrong(f'a whole number{_said(limits)}', value)
        return value

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


def _said(limits: Limits) -> str:
    """Format limits for after the word that they limit."""
    least, most = limits
    if most < math.inf:
        return f' from {least:g} to {most:g}'
    return f' of at least {least:g}' if least > -math.inf else ''


def is_number(value: Any) -> bool:
    """
    Check whether a value is a number that a float can have; infinity is one, as a bound.

    Parameters
    ----------
    value
        The value.

    """
    if isinstance(value, int):
        return not isinstance(value, bool) and abs(value) <= _LARGEST
    return isinstance(value, float) and not math.isnan(value)


def _is_finite(value: Any) -> bool:
    return is_number(value) and math.isfinite(value)


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
        and all(map(_is_finite, value))
    )
