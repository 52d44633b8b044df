# SPDX-License-Identifier: Apache-2.0
"""Values of a policy file, which are checked as they are read, with a sentence on each mistake."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
import math
from pathlib import Path
from typing import Any

from humanoid_common.naming import did_you_mean, shortened
from humanoid_control.backends import Array
import numpy as np


class PolicyError(Exception):
    """A policy cannot be run; the message says why, and what to do."""


class CheckedTable:
    """
    Names and values of a policy file, or of a part of it, which are checked as they are read.

    Parameters
    ----------
    path
        The file, for messages.
    key
        The key of the part, for messages; empty for the whole file.
    values
        The parsed values.

    Raises
    ------
    PolicyError
        They are not a table.

    """

    def __init__(self, path: Path, key: str, values: Any) -> None:
        self._path, self._key = path, key
        if not isinstance(values, Mapping):
            raise self._error(f'{key or "It"} must have names and values, but is {_said(values)}.')
        self._values = values

    def allow(self, *names: str) -> None:
        """
        Check that there is nothing but known names.

        Parameters
        ----------
        *names
            All names that are allowed.

        """
        for name in map(str, self._values):
            if name not in names:
                hint = did_you_mean(name, names) or f'Known here: {", ".join(names)}.'
                raise self._error(f"It has an unknown key '{self._of(shortened(name))}'. {hint}")

    def table(self, name: str) -> CheckedTable:
        """
        Return a part.

        Parameters
        ----------
        name
            Its name.

        """
        return CheckedTable(self._path, self._of(name), self._get(name))

    def tables(self, name: str) -> list[CheckedTable]:
        """
        Return the parts of a list, of which there must be at least one.

        Parameters
        ----------
        name
            Its name.

        """
        values = self._get(name)
        if not isinstance(values, list) or not values:
            raise self._wrong(name, 'a list of at least one', values)
        key = self._of(name)
        return [
            CheckedTable(self._path, f'{key}[{each}]', value) for each, value in enumerate(values)
        ]

    def text(self, name: str) -> str:
        """
        Read a text that is not empty.

        Parameters
        ----------
        name
            Its name.

        """
        value = self._get(name)
        if not isinstance(value, str) or not value:
            raise self._wrong(name, 'a text', value)
        return value

    def names(self, name: str) -> tuple[str, ...]:
        """
        Read a list of different names.

        Parameters
        ----------
        name
            Its name.

        """
        values = self._get(name)
        if not isinstance(values, list) or not values:
            raise self._wrong(name, 'a list of names', values)
        for value in values:
            if not isinstance(value, str) or values.count(value) > 1:
                raise self._wrong(name, 'a list of names, each once', value)
        return tuple(values)

    def choice(self, name: str, choices: Sequence[str], is_needed: bool = False) -> str:
        """
        Read one of some words.

        Parameters
        ----------
        name, choices
            Its name, and what it may be.
        is_needed
            Whether it must be given; otherwise the first choice is the default.

        """
        value = self._get(name) if is_needed else self._values.get(name, choices[0])
        if value not in choices:
            hint = did_you_mean(str(value), choices)
            raise self._wrong(name, f'one of {", ".join(choices)}', value, hint)
        return str(value)

    def number(self, name: str, least: float, most: float, default: float | None = None) -> float:
        """
        Read a number.

        Parameters
        ----------
        name
            Its name.
        least, most
            What it may be.
        default
            What it is if it is not given; None if it must be given.

        """
        value = self._values.get(name, default) if default is not None else self._get(name)
        if not _is_number(value) or not least <= value <= most:
            range_ = f'from {least:g} to {most:g}' if most < math.inf else f'of at least {least:g}'
            raise self._wrong(name, f'a number {range_}', value)
        return float(value)

    def count(self, name: str, most: int) -> int:
        """
        Read how many there are; 1 if it is not given.

        Parameters
        ----------
        name, most
            Its name, and the largest number.

        """
        value = self.number(name, 1.0, most, 1.0)
        if value != int(value):
            raise self._wrong(name, 'a whole number', value)
        return int(value)

    def vector(self, name: str, among: Sequence[str], default: Array | None = None) -> Array:
        """
        Read a number for each of some things.

        Parameters
        ----------
        name
            Its name. One number is for all; a list has their order; a table has their names.
        among
            The names of the things.
        default
            What it is if it is not given; None if it must be given.

        """
        if default is not None and name not in self._values:
            return default
        values = self._spread(name, among, self._get(name))
        if not np.isfinite(values).all():
            raise self._wrong(name, 'finite', self._values[name])
        return values

    def positive(self, name: str, among: Sequence[str]) -> Array | None:
        """
        Read a number of zero or more for each of some things; None if it is not given.

        Parameters
        ----------
        name, among
            As for `vector`.

        """
        if name not in self._values:
            return None
        values = self.vector(name, among)
        if (values < 0.0).any():
            raise self._wrong(name, 'zero or more', float(values.min()))
        return values

    def bounds(self, name: str, among: Sequence[str]) -> tuple[Array, Array]:
        """
        Read the least and the largest value of each of some things; infinite if not given.

        Parameters
        ----------
        name, among
            As for `vector`, for each of two bounds.

        """
        pair = self._values.get(name, [-math.inf, math.inf])
        if not isinstance(pair, list) or len(pair) != 2:
            raise self._wrong(name, 'a list of two bounds', pair)
        lower, upper = (self._spread(name, among, each) for each in pair)
        if (lower > upper).any():
            raise self._wrong(name, 'two bounds, the lower one first', pair)
        return lower, upper

    def _spread(self, name: str, among: Sequence[str], value: Any) -> Array:
        """Return a number for each of some things."""
        if isinstance(value, Mapping):
            for key in value:
                if key not in among:
                    raise self._error(
                        f"'{self._of(name)}' names '{shortened(str(key))}', which is not among "
                        f'its joints. {did_you_mean(str(key), among)}'
                    )
            value = [value.get(key) for key in among]
        values = value if isinstance(value, list) else [value] * len(among)
        if len(values) != len(among) or not all(map(_is_number, values)):
            raise self._wrong(name, f'a number, or {len(among)} of them', value)
        return np.array(values, dtype=np.float64)

    def _get(self, name: str) -> Any:
        """Return a value that must be there."""
        if self._values.get(name) is None:
            raise self._error(f"It lacks '{self._of(name)}'.")
        return self._values[name]

    def _of(self, name: str) -> str:
        return f'{self._key}.{name}' if self._key else name

    def _wrong(self, name: str, wanted: str, value: Any, hint: str = '') -> PolicyError:
        """Make the error about a value."""
        sentence = f"'{self._of(name)}' must be {wanted}, but is {_said(value)}. {hint}"
        return self._error(sentence.strip())

    def _error(self, sentence: str) -> PolicyError:
        return PolicyError(f"The policy file '{self._path}' has a mistake. {sentence}")


def _is_number(value: Any) -> bool:
    """Whether a value is a number; infinity is one, as a bound."""
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    return is_number and not math.isnan(value)


def _said(value: Any) -> str:
    return shortened(repr(value))
