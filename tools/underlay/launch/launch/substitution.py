# SPDX-License-Identifier: Apache-2.0
"""What becomes a text: the base class of substitutions, a constant, and the type of all such."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
import os
from typing import Any, ClassVar, NoReturn, TYPE_CHECKING, Union

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class Substitution:
    """
    A text that is known only when the launch runs.

    Attributes
    ----------
    is_constant
        Whether the text depends only on what is installed, and performing it changes nothing.

    """

    is_constant = False
    # Arguments of `$(name ...)` in a launch file, by the names that the constructor has for them.
    frontend_required: ClassVar[tuple[str, ...]] = ()
    frontend_optional: ClassVar[tuple[str, ...]] = ()

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[Any, dict[str, Any]]:
        """
        Parse the arguments of a substitution in a launch file.

        Parameters
        ----------
        data
            The arguments, each as a list of substitutions.

        Returns
        -------
        tuple
            The class, and the keyword arguments for its constructor.

        Raises
        ------
        TypeError
            There are too few or too many arguments.

        """
        names = cls.frontend_required + cls.frontend_optional
        if not len(cls.frontend_required) <= len(data) <= len(names):
            described = [*cls.frontend_required, *(f'[{name}]' for name in cls.frontend_optional)]
            raise TypeError(
                f'{cls.__name__} takes the arguments ({", ".join(described)}), but '
                f'{len(data)} are given'
            )
        return cls, dict(zip(names, data))

    def perform(self, context: LaunchContext) -> str:
        """
        Perform the substitution and return its result; subclasses override this.

        Parameters
        ----------
        context
            The launch context.

        Raises
        ------
        NotImplementedError
            The class does not override it.

        """
        raise NotImplementedError(
            f"the substitution class '{type(self).__name__}' does not define perform(context)"
        )

    def __add__(self, other: Any) -> NoReturn:
        """Raise an error that explains how to concatenate substitutions."""
        raise _no_sum(self)

    def __radd__(self, other: Any) -> NoReturn:
        """Raise an error that explains how to concatenate substitutions."""
        raise _no_sum(self)

    def describe(self) -> str:
        """Return a short human-readable description."""
        return repr(self)


class SubstitutionFailure(RuntimeError):
    """A substitution cannot be performed; the message states why."""


def _no_sum(substitution: Substitution) -> TypeError:
    name = type(substitution).__name__
    return TypeError(
        f"'{name}' cannot be added to something with '+', as its text is not known yet: "
        f"write a list, such as ['/ns/', {name}(...)]"
    )


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


SomeSubstitutionsType = Union[
    str,
    'os.PathLike[str]',
    Substitution,
    Iterable[Union[str, 'os.PathLike[str]', Substitution]],
]

SomeSubstitutionsType_types_tuple = (str, os.PathLike, Substitution, Iterable)
