# SPDX-License-Identifier: Apache-2.0
"""The error of a substitution that cannot be parsed."""

from __future__ import annotations


class InvalidSubstitutionError(RuntimeError):
    """A string has a substitution that is malformed or unknown."""

    def __init__(self, problem: str, text: str, position: int) -> None:
        """Create the error for a problem at a position in a string."""
        self.text = text
        self.position = position
        self.line = text.count('\n', 0, position) + 1
        super().__init__(f'{problem}\n{self._where()}')

    def _where(self) -> str:
        """Format the line and the column of the problem."""
        lines = self.text.split('\n')
        column = self.position - (self.text.rfind('\n', 0, self.position) + 1) + 1
        return f"It is at character {column} of '{lines[self.line - 1]}'."
