# SPDX-License-Identifier: Apache-2.0
"""The error of a substitution that cannot be read."""

from __future__ import annotations


class InvalidSubstitutionError(RuntimeError):
    """A text has a substitution in it that is written wrongly, or that is not known."""

    def __init__(self, problem: str, text: str, position: int) -> None:
        """Create the error of the problem at a position of a text."""
        self.text = text
        self.position = position
        self.line = text.count('\n', 0, position) + 1
        super().__init__(f'{problem}\n{self._where()}')

    def _where(self) -> str:
        """Return the line of the text, and how far along it the problem is."""
        lines = self.text.split('\n')
        column = self.position - (self.text.rfind('\n', 0, self.position) + 1) + 1
        return f"It is at character {column} of '{lines[self.line - 1]}'."
