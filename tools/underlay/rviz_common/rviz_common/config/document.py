# SPDX-License-Identifier: Apache-2.0
"""The values of a YAML file, and their line numbers."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

__all__ = ['Document', 'Place']

Place = tuple['str | int', ...]
"""The keys and indices that lead to a value."""


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
