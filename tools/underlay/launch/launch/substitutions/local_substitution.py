# SPDX-License-Identifier: Apache-2.0
"""The value of a local variable of the launch context."""

from __future__ import annotations

from typing import Optional, TYPE_CHECKING

from launch.substitution import Substitution, SubstitutionFailure

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class LocalSubstitution(Substitution):
    """
    Substitution of a local variable or something in it, such as `event.reason`.

    Parameters
    ----------
    expression
        The expression, which is evaluated on the local variables of the context.
    description
        A human-readable name of the substitution; by default the expression.

    """

    def __init__(self, expression: str, description: Optional[str] = None) -> None:
        self.__expression = expression
        self.__description = description

    @property
    def expression(self) -> str:
        """Return the expression."""
        return self.__expression

    def describe(self) -> str:
        """Return a short human-readable description."""
        return f"LocalVar('{self.__description or self.__expression}')"

    def perform(self, context: LaunchContext) -> str:
        """
        Return the value of the expression, which must be a string.

        Parameters
        ----------
        context
            The launch context, whose local variables are read.

        Raises
        ------
        SubstitutionFailure
            The value is not a string.

        """
        value = eval(f'context.locals.{self.__expression}', {}, {'context': context})  # noqa: S307
        if not isinstance(value, str):
            raise SubstitutionFailure(
                f"the local variable '{self.__expression}' must be a string to be used as a "
                f"substitution, but it is {value!r} of type '{type(value).__name__}'"
            )
        return value
