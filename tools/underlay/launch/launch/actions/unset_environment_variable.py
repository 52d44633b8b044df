# SPDX-License-Identifier: Apache-2.0
"""The action that removes an environment variable."""

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
