# SPDX-License-Identifier: Apache-2.0
"""Error for invalid URDFs."""

from __future__ import annotations

__all__ = ['UrdfError']


class UrdfError(ValueError):
    """A URDF is invalid; with the reason and the line to correct."""

    def __init__(self, reason: str, line: int | None = None, source: str | None = None) -> None:
        """Create the error; the source is the file or another origin of the text."""
        super().__init__(reason)
        self.reason = reason
        self.line = line
        self.source = source

    def __str__(self) -> str:
        """Return the reason, preceded by the source and line if known."""
        place = [] if self.source is None else [self.source]
        if self.line is not None:
            place.append(str(self.line) if place else f'line {self.line}')
        return ': '.join(filter(None, [':'.join(place), self.reason]))
