# SPDX-License-Identifier: Apache-2.0
"""The values of a YAML file, and the lines where they are."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

__all__ = ['Document', 'Place']

Place = tuple['str | int', ...]
"""The keys and indices that lead to a value."""


@dataclass(frozen=True)
class Document:
    """The values of a YAML file, and the lines where they are."""

    source: str
    values: Any
    lines: dict[Place, int] = field(default_factory=dict)

    def line(self, place: Place) -> int | None:
        """Return the line of a value, or of the nearest one around it that has a line."""
        for length in range(len(place), -1, -1):
            if place[:length] in self.lines:
                return self.lines[place[:length]]
        return None

    def where(self, place: Place) -> str:
        """Return the file and the line of a value."""
        line = self.line(place)
        return self.source if line is None else f'{self.source}:{line}'
