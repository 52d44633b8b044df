# SPDX-License-Identifier: Apache-2.0
"""The actions that set, extend and remove environment variables."""

from __future__ import annotations

import os
from typing import Any, TYPE_CHECKING, Union

from launch.action import Action
from launch.substitution import SomeSubstitutionsType, Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch.utilities.type_utils import normalize_typed_substitution, perform_typed_substitution

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext


class SetEnvironmentVariable(Action):
    """
    Action that sets an environment variable of the launch and of the processes it starts later.

    Parameters
    ----------
    name
        The name of the variable.
    value
        Its value.
    **kwargs
        Keyword arguments of `Action`.

    """

    def __init__(
        self,
        name: SomeSubstitutionsType,
        value: SomeSubstitutionsType,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.__name = normalize_to_list_of_substitutions(name)
        self.__value = normalize_to_list_of_substitutions(value)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """
        Read `name` and `value` of the element `set_env`.

        Parameters
        ----------
        entity, parser
            As for `Action.parse`.

        Returns
        -------
        tuple
            The class, and the keyword arguments for its constructor.

        """
        _, kwargs = super().parse(entity, parser)
        kwargs['name'] = parser.parse_substitution(entity.get_attr('name'))
        kwargs['value'] = parser.parse_substitution(entity.get_attr('value'))
        return cls, kwargs

    @property
    def name(self) -> list[Substitution]:
        """Return the name as a list of substitutions."""
        return self.__name

    @property
    def value(self) -> list[Substitution]:
        """Return the value as a list of substitutions."""
        return self.__value

    def execute(self, context: LaunchContext) -> None:
        """
        Set the environment variable.

        Parameters
        ----------
        context
            The launch context, in which name and value are performed.

        """
        name = perform_substitutions(context, self.__name)
        context.environment[name] = value = perform_substitutions(context, self.__value)
        context.run.note(name=name, value=value)


class AppendEnvironmentVariable(Action):
    """
    Action that adds a value to an environment variable, behind or before what it has.

    Parameters
    ----------
    name
        The name of the variable.
    value
        The value to add.
    prepend
        Whether to prepend rather than append it.
    separator
        The separator between both values, by default that of paths (`:`).
    **kwargs
        Keyword arguments of `Action`.

    """

    def __init__(
        self,
        name: SomeSubstitutionsType,
        value: SomeSubstitutionsType,
        prepend: Union[bool, SomeSubstitutionsType] = False,
        separator: SomeSubstitutionsType = os.pathsep,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.__name = normalize_to_list_of_substitutions(name)
        self.__value = normalize_to_list_of_substitutions(value)
        self.__prepend = normalize_typed_substitution(prepend, bool)
        self.__separator = normalize_to_list_of_substitutions(separator)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """
        Read `name`, `value`, `prepend` and `separator` of the element `append_env`.

        Parameters
        ----------
        entity, parser
            As for `Action.parse`.

        Returns
        -------
        tuple
            The class, and the keyword arguments for its constructor.

        """
        _, kwargs = super().parse(entity, parser)
        kwargs['name'] = parser.parse_substitution(entity.get_attr('name'))
        kwargs['value'] = parser.parse_substitution(entity.get_attr('value'))
        prepend = entity.get_attr('prepend', data_type=bool, optional=True)
        if prepend is not None:
            kwargs['prepend'] = parser.parse_if_substitutions(prepend)
        separator = entity.get_attr('separator', optional=True)
        if separator is not None:
            kwargs['separator'] = parser.parse_substitution(separator)
        return cls, kwargs

    @property
    def name(self) -> list[Substitution]:
        """Return the name as a list of substitutions."""
        return self.__name

    @property
    def value(self) -> list[Substitution]:
        """Return the value as a list of substitutions."""
        return self.__value

    @property
    def separator(self) -> list[Substitution]:
        """Return the separator as a list of substitutions."""
        return self.__separator

    def execute(self, context: LaunchContext) -> None:
        """
        Append or prepend the value; an unset variable is set to it.

        Parameters
        ----------
        context
            The launch context, in which substitutions are performed.

        """
        name = perform_substitutions(context, self.__name)
        values = [perform_substitutions(context, self.__value)]
        if name in context.environment:
            before = perform_typed_substitution(context, self.__prepend, bool)
            values.insert(len(values) if before else 0, context.environment[name])
        separator = perform_substitutions(context, self.__separator)
        context.environment[name] = value = separator.join(values)
        context.run.note(name=name, value=value)


class UnsetEnvironmentVariable(Action):
    """
    Action that removes an environment variable if it is set.

    Parameters
    ----------
    name
        The name of the variable.
    **kwargs
        Keyword arguments of `Action`.

    """

    def __init__(self, name: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__name = normalize_to_list_of_substitutions(name)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """
        Read `name` of the element `unset_env`.

        Parameters
        ----------
        entity, parser
            As for `Action.parse`.

        Returns
        -------
        tuple
            The class, and the keyword arguments for its constructor.

        """
        _, kwargs = super().parse(entity, parser)
        kwargs['name'] = parser.parse_substitution(entity.get_attr('name'))
        return cls, kwargs

    @property
    def name(self) -> list[Substitution]:
        """Return the name as a list of substitutions."""
        return self.__name

    def execute(self, context: LaunchContext) -> None:
        """
        Remove the environment variable.

        Parameters
        ----------
        context
            The launch context, in which the name is performed.

        """
        name = perform_substitutions(context, self.__name)
        context.environment.pop(name, None)
        context.run.note(name=name)
