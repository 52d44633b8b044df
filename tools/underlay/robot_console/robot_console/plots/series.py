# SPDX-License-Identifier: Apache-2.0
"""Plotted series: a numeric message field, or the difference of two."""

from __future__ import annotations

from dataclasses import dataclass

from robot_console.plots.field_path import FieldPath, parse_path, PathError

__all__ = ['MAX_SERIES', 'Series', 'parse_all', 'parse_series']

MAX_SERIES = 8
MINUS = ' - '


@dataclass(frozen=True)
class Series:
    """A numeric message field, or the first of two minus the second."""

    paths: tuple[FieldPath, ...]

    def __str__(self) -> str:
        """Return the series as text."""
        return MINUS.join(map(str, self.paths))

    def value(self, newest: list[float]) -> float:
        """
        Compute the value of the series from the numbers at its paths.

        Parameters
        ----------
        newest
            The latest number of each path, in order.

        """
        return newest[0] if len(newest) == 1 else newest[0] - newest[1]


def parse_series(text: str) -> Series:
    """
    Parse a series: a path, or the difference of two paths.

    Parameters
    ----------
    text
        `PATH` or `PATH - PATH`, with a space on each side of the minus.

    Raises
    ------
    PathError
        The text is neither.

    """
    parts = text.split(MINUS)
    if len(parts) > 2:
        raise PathError(f"'{text}' has more than one minus; a series is a path, or PATH - PATH.")
    return Series(tuple(map(parse_path, parts)))


def parse_all(text: str) -> list[Series]:
    """
    Parse a list of series; duplicates count once.

    Parameters
    ----------
    text
        Series separated by semicolons; may be empty.

    Raises
    ------
    PathError
        A part is not a valid series, or there are more than 8.

    """
    series = list(dict.fromkeys(parse_series(part) for part in text.split(';') if part.strip()))
    if len(series) > MAX_SERIES:
        raise PathError(f'{len(series)} series are too many for a plot: {MAX_SERIES} at most.')
    return series
