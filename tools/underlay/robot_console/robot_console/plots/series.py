# SPDX-License-Identifier: Apache-2.0
"""What is plotted: a number of messages, or the difference of two."""

from __future__ import annotations

from dataclasses import dataclass

from robot_console.plots.field_path import FieldPath, parse_path, PathError

__all__ = ['MAX_SERIES', 'Series', 'parse_all', 'parse_series']

MAX_SERIES = 8
MINUS = ' - '


@dataclass(frozen=True)
class Series:
    """A number of messages, or the first of two minus the second."""

    paths: tuple[FieldPath, ...]

    def __str__(self) -> str:
        """Return the series as it is written."""
        return MINUS.join(map(str, self.paths))

    def value(self, newest: list[float]) -> float:
        """Return the number to be plotted."""
        return newest[0] if len(newest) == 1 else newest[0] - newest[1]


def parse_series(text: str) -> Series:
    """Return the series that a text means, or raise PathError."""
    parts = text.split(MINUS)
    if len(parts) > 2:
        raise PathError(f"'{text}' has more than one minus; a series is a path, or PATH - PATH.")
    return Series(tuple(map(parse_path, parts)))


def parse_all(text: str) -> list[Series]:
    """Return the series of a text that has semicolons between them, or raise PathError."""
    series = list(dict.fromkeys(parse_series(part) for part in text.split(';') if part.strip()))
    if len(series) > MAX_SERIES:
        raise PathError(f'{len(series)} series are too many for a plot: {MAX_SERIES} at most.')
    return series
