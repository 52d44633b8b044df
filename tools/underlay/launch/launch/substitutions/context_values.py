# SPDX-License-Identifier: Apache-2.0
"""The values that the launch context holds: configurations, environment and local variables."""

from __future__ import annotations

from collections.abc import Iterable
import os
from typing import Any, Optional, TYPE_CHECKING

from launch.substitution import SomeSubstitutionsType, Substitution, SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from ros_environment.suggestions import did_you_mean

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class LaunchConfiguration(Substitution):
    """
    Substitution of the value that a launch configuration has at run time.

    Parameters
    ----------
    variable_name
        The name of the configuration.
    default
        The value if it is not set, converted to a string; without a default, this is an error.

    """

    frontend_required = ('variable_name',)
    frontend_optional = ('default',)

    def __init__(
        self,
        variable_name: SomeSubstitutionsType,
        *,
        default: Optional[Any] = None,
    ) -> None:
        self.__variable_name = normalize_to_list_of_substitutions(variable_name)
        self.__default = None if default is None else _normalize_default(default)

    @property
    def variable_name(self) -> list[Substitution]:
        """Return the name as a list of substitutions."""
        return self.__variable_name

    def __repr__(self) -> str:
        """Format the class with the description of the name."""
        name = ' + '.join(sub.describe() for sub in self.__variable_name)
        return f'{type(self).__name__}({name})'

    def describe(self) -> str:
        """Return a short human-readable description."""
        return f'LaunchConfig({" + ".join(sub.describe() for sub in self.__variable_name)})'

    def perform(self, context: LaunchContext) -> str:
        """
        Return the value of the launch configuration, or else the default.

        Parameters
        ----------
        context
            The launch context, whose launch configurations are read.

        Raises
        ------
        SubstitutionFailure
            The configuration is not set, and there is no default.

        """
        name = perform_substitutions(context, self.__variable_name)
        if name in context.launch_configurations:
            return str(context.launch_configurations[name])
        if self.__default is not None:
            return perform_substitutions(context, self.__default)
        raise SubstitutionFailure(_missing(name, context))


def _normalize_default(default: Any) -> list[Substitution]:
    if isinstance(default, (str, os.PathLike, Substitution)):
        return normalize_to_list_of_substitutions(default)
    if isinstance(default, Iterable):
        return normalize_to_list_of_substitutions(
            [
                item if isinstance(item, (str, os.PathLike, Substitution)) else str(item)
                for item in default
            ]
        )
    return normalize_to_list_of_substitutions(str(default))


def _missing(name: str, context: LaunchContext) -> str:
    """Format the error about an unset configuration, with a suggestion."""
    text = f"launch configuration '{name}' does not exist"
    return '. '.join(filter(None, [text, did_you_mean(name, context.launch_configurations)]))


class EnvironmentVariable(Substitution):
    """
    Substitution of the value that an environment variable has at run time.

    Parameters
    ----------
    name
        The name of the variable.
    default_value
        The value if it is not set; without a default, an unset variable is an error.

    """

    frontend_required = ('name',)
    frontend_optional = ('default_value',)

    def __init__(
        self,
        name: SomeSubstitutionsType,
        *,
        default_value: Optional[SomeSubstitutionsType] = None,
    ) -> None:
        self.__name = normalize_to_list_of_substitutions(name)
        self.__default_value = (
            None if default_value is None else normalize_to_list_of_substitutions(default_value)
        )

    @property
    def name(self) -> list[Substitution]:
        """Return the name as a list of substitutions."""
        return self.__name

    @property
    def default_value(self) -> Optional[list[Substitution]]:
        """Return the default as a list of substitutions, or None."""
        return self.__default_value

    def describe(self) -> str:
        """Return a short human-readable description."""
        return f'EnvVar({" + ".join(sub.describe() for sub in self.__name)})'

    def perform(self, context: LaunchContext) -> str:
        """
        Return the value of the environment variable, or else the default.

        Parameters
        ----------
        context
            The launch context, whose environment is read.

        Raises
        ------
        SubstitutionFailure
            The variable is not set, and there is no default.

        """
        name = perform_substitutions(context, self.__name)
        value = context.environment.get(name)
        if value is not None:
            return value
        if self.__default_value is None:
            raise SubstitutionFailure(f"environment variable '{name}' does not exist")
        return perform_substitutions(context, self.__default_value)


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
