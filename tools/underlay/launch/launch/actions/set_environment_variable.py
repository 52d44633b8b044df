# SPDX-License-Identifier: Apache-2.0
"""The action that sets an environment variable."""

from __future__ import annotations

from typing import Any, TYPE_CHECKING

from launch.action import Action
from launch.some_substitutions_type import SomeSubstitutionsType
from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

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
