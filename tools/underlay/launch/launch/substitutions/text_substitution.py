# SPDX-License-Identifier: Apache-2.0
"""A constant string."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.substitution import Substitution

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class TextSubstitution(Substitution):
    """
    Substitution of a text that is known already.

    Parameters
    ----------
    text
        The text.

    Raises
    ------
    TypeError
        The text is not a `str`.

    """

    is_constant = True

    def __init__(self, *, text: str) -> None:
        if not isinstance(text, str):
            raise TypeError(
                f"TextSubstitution expected the text to be a 'str', "
                f"but got {text!r} of type '{type(text).__name__}'"
            )
        self.__text = text

    @property
    def text(self) -> str:
        """Return the text."""
        return self.__text

    def __repr__(self) -> str:
        """Format the class with the text."""
        return f'{type(self).__name__}({self.__text!r})'

    def describe(self) -> str:
        """Return the text in quotes."""
        return f"'{self.__text}'"

    def perform(self, context: LaunchContext) -> str:
        """
        Return the text.

        Parameters
        ----------
        context
            The launch context, which is not used.

        """
        return self.__text
