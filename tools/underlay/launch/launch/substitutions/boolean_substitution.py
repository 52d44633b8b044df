# SPDX-License-Identifier: Apache-2.0
"""Boolean logic."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import partial
from typing import Any, TYPE_CHECKING

from launch.some_substitutions_type import SomeSubstitutionsType
from launch.substitution import Substitution, SubstitutionFailure
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
