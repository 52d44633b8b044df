# SPDX-License-Identifier: Apache-2.0
"""A condition that is fulfilled by a true expression."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.condition import Condition
from launch.conditions.evaluate_condition_expression_impl import evaluate_condition_expression
from launch.some_substitutions_type import SomeSubstitutionsType, SomeSubstitutionsType_types_tuple
from launch.utilities.ensure_argument_type_impl import ensure_argument_type
from launch.utilities.normalize_to_list_of_substitutions_impl import (
    normalize_to_list_of_substitutions,
)

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class IfCondition(Condition):
    """
    Condition that is fulfilled if an expression is true or 1, and not if it is false or 0.

    Evaluating any other expression raises an error.

    Parameters
    ----------
    predicate_expression
        A string, a path, a substitution or an iterable of them.

    Raises
    ------
    TypeError
        The expression is none of these.

    """

    def __init__(self, predicate_expression: SomeSubstitutionsType) -> None:
        ensure_argument_type(
            predicate_expression,
            SomeSubstitutionsType_types_tuple,
            'predicate_expression',
            type(self).__name__,
        )
        self.__predicate_expression = normalize_to_list_of_substitutions(predicate_expression)
        super().__init__(predicate=self._predicate_func)

    def describe(self) -> str:
        """Return a short human-readable description."""
        parts = ' + '.join(sub.describe() for sub in self.__predicate_expression)
        return f'{type(self).__name__}({parts})'

    def _predicate_func(self, context: LaunchContext) -> bool:
        return evaluate_condition_expression(context, self.__predicate_expression)
