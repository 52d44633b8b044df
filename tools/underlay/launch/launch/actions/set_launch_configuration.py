# SPDX-License-Identifier: Apache-2.0
"""The action that sets a launch configuration."""

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


class SetLaunchConfiguration(Action):
    """
    Action that sets a launch configuration, which stays set until its scope ends.

    Parameters
    ----------
    name
        The name of the configuration.
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
        Read `name` and `value` of the element `let`.

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
        Set the launch configuration.

        Parameters
        ----------
        context
            The launch context, in which name and value are performed.

        """
        name = perform_substitutions(context, self.__name)
        value = perform_substitutions(context, self.__value)
        context.launch_configurations[name] = value
        context.run.note(name=name, value=value)
