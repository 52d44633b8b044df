# SPDX-License-Identifier: Apache-2.0
"""Evaluate an expression as a boolean."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from launch.substitution import Substitution
from launch.utilities.perform_substitutions_impl import perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

VALID_TRUE_EXPRESSIONS = ['true', '1']
VALID_FALSE_EXPRESSIONS = ['false', '0']


class InvalidConditionExpressionError(Exception):
    """An expression is neither true nor false."""

    def __init__(self, expression: str, expected: Iterable[str], origin: str) -> None:
        """Create the error from the expanded expression and its origin."""
        super().__init__(
            f'invalid condition expression, expected one of [{", ".join(expected)}] '
            f"but got '{expression}', expanded from '{origin}'"
        )


def evaluate_condition_expression(
    context: LaunchContext,
    expression: Iterable[Substitution],
) -> bool:
    """
    Evaluate an expression as a boolean: true, 1, false or 0, case-insensitively.

    Parameters
    ----------
    context
        The launch context, in which the expression is performed.
    expression
        The substitutions, which are concatenated; surrounding whitespace is ignored.

    Raises
    ------
    InvalidConditionExpressionError
        The result is none of these words.

    """
    parts = list(expression)
    text = perform_substitutions(context, parts).strip().lower()
    if context._observer is not None:
        context._observer.expanded(text)
    if text in VALID_TRUE_EXPRESSIONS:
        return True
    if text in VALID_FALSE_EXPRESSIONS:
        return False
    raise InvalidConditionExpressionError(
        text,
        VALID_TRUE_EXPRESSIONS + VALID_FALSE_EXPRESSIONS,
        ', '.join(part.describe() for part in parts),
    )
