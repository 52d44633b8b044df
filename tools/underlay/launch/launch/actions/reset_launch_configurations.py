# SPDX-License-Identifier: Apache-2.0
"""The action that removes launch configurations."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Optional, TYPE_CHECKING

from launch.action import Action
from launch.some_substitutions_type import SomeSubstitutionsType
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext


class ResetLaunchConfigurations(Action):
    """
    Action that removes all launch configurations but those that are given.

    Parameters
    ----------
    launch_configurations
        The launch configurations to set, values by name; they may refer to configurations that
        are removed.
    **kwargs
        Keyword arguments of `Action`.

    """

    resets_configurations = True

    def __init__(
        self,
        launch_configurations: Optional[
            Mapping[SomeSubstitutionsType, SomeSubstitutionsType]
        ] = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.__kept = [
            (normalize_to_list_of_substitutions(name), normalize_to_list_of_substitutions(value))
            for name, value in (launch_configurations or {}).items()
        ]

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """
        Read the children `keep` of the element `reset`.

        Parameters
        ----------
        entity, parser
            As for `Action.parse`.

        Returns
        -------
        tuple
            The class, and the keyword arguments for its constructor.

        """
        from launch.frontend.attributes import parse_pairs

        _, kwargs = super().parse(entity, parser)
        kwargs['launch_configurations'] = dict(parse_pairs(entity, parser, 'keep'))
        return cls, kwargs

    def execute(self, context: LaunchContext) -> None:
        """
        Replace all launch configurations by the given ones.

        Parameters
        ----------
        context
            The launch context, in which they are performed first.

        """
        kept = {
            perform_substitutions(context, name): perform_substitutions(context, value)
            for name, value in self.__kept
        }
        context.launch_configurations.clear()
        context.launch_configurations.update(kept)
