# SPDX-License-Identifier: Apache-2.0
"""Comparisons of two values."""

from __future__ import annotations

from typing import Any, Optional, TYPE_CHECKING, Union

from launch.some_substitutions_type import SomeSubstitutionsType
from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


Comparable = Optional[Union[bool, int, float, SomeSubstitutionsType]]


class EqualsSubstitution(Substitution):
    """
    Substitution that stands for `true` if two values are equal, as truth values, numbers or texts.

    Parameters
    ----------
    left, right
        The values, or substitutions that resolve to them; None is an empty string.

    """

    frontend_required = ('left', 'right')

    def __init__(self, left: Comparable, right: Comparable) -> None:
        self.__left = _normalize(left)
        self.__right = _normalize(right)

    @property
    def left(self) -> list[Substitution]:
        """Return the first value as a list of substitutions."""
        return self.__left

    @property
    def right(self) -> list[Substitution]:
        """Return the second value as a list of substitutions."""
        return self.__right

    def describe(self) -> str:
        """Return a short human-readable description."""
        left, right = (
            ' + '.join(sub.describe() for sub in side) for side in (self.__left, self.__right)
        )
        return f'{type(self).__name__}({left} {right})'

    def perform(self, context: LaunchContext) -> str:
        """
        Compare the values; return `true` or `false`.

        Parameters
        ----------
        context
            The launch context, in which the values are performed.

        """
        return 'true' if self._equal(context) else 'false'

    def _equal(self, context: LaunchContext) -> bool:
        left = perform_substitutions(context, self.__left)
        right = perform_substitutions(context, self.__right)
        return same_value(left, right)


def same_value(left: str, right: str) -> bool:
    """
    Whether two strings are equal: as booleans or numbers if both are such, else as strings.

    Parameters
    ----------
    left, right
        The strings; true, 1, false and 0 are booleans.

    """
    truths = [_truth(left), _truth(right)]
    if None not in truths:
        return truths[0] == truths[1]
    try:
        numbers = float(left), float(right)
    except ValueError:
        return left == right
    import math

    return math.isclose(*numbers)


def _truth(text: str) -> Optional[bool]:
    return {'true': True, '1': True, 'false': False, '0': False}.get(text.lower())


def _normalize(value: Any) -> list[Substitution]:
    if value is None:
        value = ''
    elif isinstance(value, bool):
        value = str(value).lower()
    elif isinstance(value, (int, float)):
        value = str(value)
    return normalize_to_list_of_substitutions(value)


class NotEqualsSubstitution(EqualsSubstitution):
    """Stands for `true` if two values differ."""

    def perform(self, context: LaunchContext) -> str:
        """
        Compare the values; return `true` if they differ, else `false`.

        Parameters
        ----------
        context
            The launch context, in which the values are performed.

        """
        return 'false' if self._equal(context) else 'true'
