# SPDX-License-Identifier: Apache-2.0
"""How a launch file decides: comparisons, boolean logic, and the choice between two texts."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import partial
from typing import Any, Optional, TYPE_CHECKING, Union

from launch.substitution import SomeSubstitutionsType, Substitution, SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch.utilities.type_utils import read_boolean

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class _BooleanSubstitution(Substitution):
    """Base class of boolean substitutions, whose operands resolve to booleans."""

    def __init__(self, *operands: SomeSubstitutionsType) -> None:
        """Create the substitution of some operands."""
        self._operands = [normalize_to_list_of_substitutions(each) for each in operands]

    def describe(self) -> str:
        """Return a short human-readable description."""
        operands = (' + '.join(sub.describe() for sub in each) for each in self._operands)
        return f'{type(self).__name__}({", ".join(operands)})'

    def perform(self, context: LaunchContext) -> str:
        """Return `true` or `false`."""
        return 'true' if self._decide(self._values(context)) else 'false'

    def _values(self, context: LaunchContext) -> list[bool]:
        texts = [perform_substitutions(context, each) for each in self._operands]
        try:
            return [read_boolean(text) for text in texts]
        except ValueError as error:
            raise SubstitutionFailure(f'{self.describe()}: {error}') from error

    def _decide(self, values: list[bool]) -> bool:
        raise NotImplementedError


class NotSubstitution(_BooleanSubstitution):
    """
    Substitution that stands for `true` if the operand is false, and the other way round.

    Parameters
    ----------
    value
        The operand.

    """

    frontend_required = ('value',)

    def __init__(self, value: SomeSubstitutionsType) -> None:
        super().__init__(value)

    @property
    def value(self) -> list[Substitution]:
        """Return the operand as a list of substitutions."""
        return self._operands[0]

    def _decide(self, values: list[bool]) -> bool:
        return not values[0]


class _BinarySubstitution(_BooleanSubstitution):
    """Base class of boolean substitutions with two operands."""

    frontend_required = ('left', 'right')

    def __init__(self, left: SomeSubstitutionsType, right: SomeSubstitutionsType) -> None:
        """Create the substitution of two operands."""
        super().__init__(left, right)

    @property
    def left(self) -> list[Substitution]:
        """Return the first operand as a list of substitutions."""
        return self._operands[0]

    @property
    def right(self) -> list[Substitution]:
        """Return the second operand as a list of substitutions."""
        return self._operands[1]


class AndSubstitution(_BinarySubstitution):
    """Stands for `true` if both operands are true."""

    def _decide(self, values: list[bool]) -> bool:
        return all(values)


class OrSubstitution(_BinarySubstitution):
    """Stands for `true` if an operand is true."""

    def _decide(self, values: list[bool]) -> bool:
        return any(values)


class _ManySubstitution(_BooleanSubstitution):
    """Base class of boolean substitutions with any number of operands."""

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[Any, dict[str, Any]]:
        """Return a factory of the substitution, with any number of operands."""
        return partial(cls, *data), {}

    @property
    def args(self) -> Iterable[list[Substitution]]:
        """Return the operands."""
        return self._operands


class AnySubstitution(_ManySubstitution):
    """Stands for `true` if any of the operands is true."""

    def _decide(self, values: list[bool]) -> bool:
        return any(values)


class AllSubstitution(_ManySubstitution):
    """Stands for `true` if all operands are true."""

    def _decide(self, values: list[bool]) -> bool:
        return all(values)


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


class IfElseSubstitution(Substitution):
    """
    Substitution of one of two texts; only the one that is chosen is performed.

    Parameters
    ----------
    condition
        The condition, which must resolve to a boolean.
    if_value
        The text if it is true.
    else_value
        The text if it is false.

    Raises
    ------
    RuntimeError
        Both strings are empty.

    """

    frontend_required = ('condition',)
    frontend_optional = ('if_value', 'else_value')

    def __init__(
        self,
        condition: SomeSubstitutionsType,
        if_value: SomeSubstitutionsType = '',
        else_value: SomeSubstitutionsType = '',
    ) -> None:
        if if_value == else_value == '':
            raise RuntimeError(
                'IfElseSubstitution needs an if_value or an else_value, but both are empty'
            )
        self.__condition = normalize_to_list_of_substitutions(condition)
        self.__if_value = normalize_to_list_of_substitutions(if_value)
        self.__else_value = normalize_to_list_of_substitutions(else_value)

    @property
    def condition(self) -> list[Substitution]:
        """Return the condition as a list of substitutions."""
        return self.__condition

    @property
    def if_value(self) -> list[Substitution]:
        """Return the value for a true condition as a list of substitutions."""
        return self.__if_value

    @property
    def else_value(self) -> list[Substitution]:
        """Return the value for a false condition as a list of substitutions."""
        return self.__else_value

    def describe(self) -> str:
        """Return a short human-readable description."""
        parts = (
            ' + '.join(sub.describe() for sub in each)
            for each in (self.__condition, self.__if_value, self.__else_value)
        )
        return f'IfElseSubstitution({", ".join(parts)})'

    def perform(self, context: LaunchContext) -> str:
        """
        Return the string that the condition selects.

        Parameters
        ----------
        context
            The launch context, in which condition and text are performed.

        Raises
        ------
        SubstitutionFailure
            The condition is not a boolean.

        """
        condition = perform_substitutions(context, self.__condition)
        try:
            chosen = self.__if_value if read_boolean(condition) else self.__else_value
        except ValueError as error:
            raise SubstitutionFailure(f'{self.describe()}: {error}') from error
        return perform_substitutions(context, chosen)
