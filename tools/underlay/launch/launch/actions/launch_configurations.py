# SPDX-License-Identifier: Apache-2.0
"""The actions that set and remove launch configurations."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Optional, TYPE_CHECKING

from launch.action import Action
from launch.substitution import SomeSubstitutionsType, Substitution
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


class UnsetLaunchConfiguration(Action):
    """
    Action that removes a launch configuration if it is set.

    Parameters
    ----------
    name
        The name of the configuration.
    **kwargs
        Keyword arguments of `Action`.

    """

    def __init__(self, name: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__name = normalize_to_list_of_substitutions(name)

    @property
    def name(self) -> list[Substitution]:
        """Return the name as a list of substitutions."""
        return self.__name

    def execute(self, context: LaunchContext) -> None:
        """
        Remove the launch configuration.

        Parameters
        ----------
        context
            The launch context, in which the name is performed.

        """
        context.launch_configurations.pop(perform_substitutions(context, self.__name), None)


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
