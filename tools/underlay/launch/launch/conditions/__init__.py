# SPDX-License-Identifier: Apache-2.0
"""The conditions under which an action is executed, and their base class."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Optional, TYPE_CHECKING
import warnings

from launch.substitution import (
    SomeSubstitutionsType,
    SomeSubstitutionsType_types_tuple,
    Substitution,
)
from launch.utilities import (
    ensure_argument_type,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)
from ros_environment.lazy import also_found_at, lazy_exports

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

__all__ = [
    'IfCondition',
    'LaunchConfigurationEquals',
    'LaunchConfigurationNotEquals',
    'UnlessCondition',
    'evaluate_condition_expression',
]

VALID_TRUE_EXPRESSIONS = ['true', '1']
VALID_FALSE_EXPRESSIONS = ['false', '0']


class Condition:
    """
    Base class of conditions: a question that decides whether an action is executed.

    Parameters
    ----------
    predicate
        Called with the launch context; without one the condition is never fulfilled.

    """

    def __init__(self, *, predicate: Optional[Callable[[LaunchContext], bool]] = None) -> None:
        self._predicate = predicate

    def describe(self) -> str:
        """Return a short human-readable description."""
        return repr(self)

    def evaluate(self, context: LaunchContext) -> bool:
        """
        Evaluate the condition in the current state of the launch.

        Parameters
        ----------
        context
            The launch context, which is passed to the predicate.

        Returns
        -------
        bool
            Whether the condition is fulfilled.

        """
        return self._predicate(context) if self._predicate is not None else False


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
    if context.run.observer is not None:
        context.run.observer.expanded(text)
    if text in VALID_TRUE_EXPRESSIONS:
        return True
    if text in VALID_FALSE_EXPRESSIONS:
        return False
    raise InvalidConditionExpressionError(
        text,
        VALID_TRUE_EXPRESSIONS + VALID_FALSE_EXPRESSIONS,
        ', '.join(part.describe() for part in parts),
    )


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


class UnlessCondition(IfCondition):
    """Fulfilled if an expression is false or 0, not if it is true or 1; else an error."""

    def _predicate_func(self, context: LaunchContext) -> bool:
        return not super()._predicate_func(context)


class LaunchConfigurationEquals(Condition):
    """
    Condition that is fulfilled if a launch configuration has a value.

    Deprecated, with a warning: use `IfCondition(EqualsSubstitution(...))` instead.

    Parameters
    ----------
    launch_configuration_name
        The name of the configuration.
    expected_value
        The string or substitutions to compare with; None for a configuration that is not set.

    """

    def __init__(
        self,
        launch_configuration_name: str,
        expected_value: Optional[SomeSubstitutionsType],
    ) -> None:
        self._name = launch_configuration_name
        self._expected = (
            None if expected_value is None else normalize_to_list_of_substitutions(expected_value)
        )
        super().__init__(predicate=self._predicate_func)
        warnings.warn(
            f'{type(self).__name__} is deprecated; write '
            "IfCondition(EqualsSubstitution(LaunchConfiguration('name'), 'value')) instead, or "
            'with NotEqualsSubstitution',
            UserWarning,
            stacklevel=2,
        )

    def describe(self) -> str:
        """Return a short human-readable description."""
        expected = ' + '.join(sub.describe() for sub in self._expected or ()) or None
        return f"{type(self).__name__}('{self._name}', {expected})"

    def _equals(self, context: LaunchContext) -> bool:
        value = context.launch_configurations.get(self._name)
        if context.run.observer is not None:
            context.run.observer.expanded('not set' if value is None else str(value))
        if self._expected is None or value is None:
            return value is None and self._expected is None
        return str(value) == perform_substitutions(context, self._expected)

    def _predicate_func(self, context: LaunchContext) -> bool:
        return self._equals(context)


class LaunchConfigurationNotEquals(LaunchConfigurationEquals):
    """Fulfilled if a launch configuration does not have a value."""

    def _predicate_func(self, context: LaunchContext) -> bool:
        return not self._equals(context)


# ROS 2 Jazzy has a module for each of them; launch files import from those, too.
also_found_at(
    __name__,
    'evaluate_condition_expression_impl',
    'if_condition',
    'launch_configuration_equals',
    'launch_configuration_not_equals',
    'unless_condition',
)

__getattr__, __dir__ = lazy_exports(__name__, __all__)
