# SPDX-License-Identifier: Apache-2.0
"""Where a value stands in a file, and errors that say so."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

from humanoid_common.errors import UserError
from humanoid_common.naming import did_you_mean, shortened

T = TypeVar('T')


class TableError(UserError):
    """A file cannot be read, or has a mistake; the message gives its location."""


@dataclass(frozen=True)
class SourceLocation:
    """A location in a file; line 0 is unknown."""

    file: str
    line: int = 0
    key: str = ''
    """The path of the key, such as `things[0].size`; empty is the whole file."""

    def of(self, key: str, line: int) -> SourceLocation:
        """
        Locate a value within this table.

        Parameters
        ----------
        key
            Name of the value.
        line
            Its line, from 1 on; 0 if unknown, which gives the line of the table.

        """
        return SourceLocation(
            self.file, line or self.line, f'{self.key}.{key}' if self.key else key
        )

    def item(self, number: int, line: int) -> SourceLocation:
        """
        Locate an item of this list.

        Parameters
        ----------
        number
            Index of the item, from 0 on.
        line
            Its line, from 1 on; 0 if unknown, which gives the line of the list.

        """
        return SourceLocation(self.file, line or self.line, f'{self.key}[{number}]')

    def error(self, sentence: str) -> TableError:
        """
        Make an error that names the file and the line.

        Parameters
        ----------
        sentence
            What is wrong there.

        Returns
        -------
        TableError
            To be raised by the caller.

        """
        where = f'{self.file}, line {self.line}' if self.line else self.file
        return TableError(f'{where}: {sentence}')

    @property
    def name(self) -> str:
        """Return what messages call the value: its path, or 'the file'."""
        return self.key or 'the file'

    def wrong(self, wanted: str, value: Any) -> TableError:
        """
        Make an error for a value of the wrong type.

        Parameters
        ----------
        wanted
            What the value must be.
        value
            What it is.

        Returns
        -------
        TableError
            To be raised by the caller.

        """
        return self.error(f'{self.name} must be {wanted}, but is {_said(value)}.')

    def not_among(self, choices: Sequence[str], value: str) -> TableError:
        """
        Make an error for a string that is none of several choices; it suggests the closest one.

        Parameters
        ----------
        choices
            The strings that are allowed.
        value
            What the value is.

        Returns
        -------
        TableError
            To be raised by the caller.

        """
        hint = did_you_mean(value, choices)
        return self.error(
            f"{self.name} must be one of {', '.join(choices)}, but is '{value}'. {hint}".rstrip()
        )

    def missing(self, key: str) -> TableError:
        """
        Make an error for a required value that this table does not set.

        Parameters
        ----------
        key
            Name of the value.

        Returns
        -------
        TableError
            To be raised by the caller.

        """
        return self.error(f"{self.name} lacks the required key '{key}'.")

    def checked(self, make: Callable[[], T]) -> T:
        """
        Build an object from the values here, and add this location to an error.

        Parameters
        ----------
        make
            Builds the object.

        Returns
        -------
        T
            What `make` returns.

        Raises
        ------
        TableError
            `make` raised UserError; a TableError, which has a location, passes unchanged.

        """
        try:
            return make()
        except TableError:
            raise
        except UserError as error:
            raise self.error(str(error)) from error


def _said(value: Any) -> str:
    """Write a value for a message."""
    if value is None:
        return 'empty'
    try:
        return shortened(repr(value))
    except ValueError:  # Python writes no numbers of thousands of digits
        return 'too large a number'
