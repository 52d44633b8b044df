# SPDX-License-Identifier: Apache-2.0
"""The error that refuses a URDF."""

from __future__ import annotations

__all__ = ['UrdfError']


class UrdfError(ValueError):
    """Refuses a URDF, with the reason and the line that is to be corrected."""

    def __init__(self, reason: str, line: int | None = None, source: str | None = None) -> None:
        """Set the reason; the source is the file, or where else the text is from."""
        super().__init__(reason)
        self.reason = reason
        self.line = line
        self.source = source

    def __str__(self) -> str:
        """Return the reason, after the place if it is known."""
        place = [] if self.source is None else [self.source]
        if self.line is not None:
            place.append(str(self.line) if place else f'line {self.line}')
        return ': '.join(filter(None, [':'.join(place), self.reason]))
