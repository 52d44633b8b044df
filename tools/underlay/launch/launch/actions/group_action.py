# SPDX-License-Identifier: Apache-2.0
"""The action that groups others."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, Optional, TYPE_CHECKING, Union

from launch.action import Action
from launch.actions import (
    PopEnvironment,
    PopLaunchConfigurations,
    PushEnvironment,
    PushLaunchConfigurations,
    ResetEnvironment,
)
from launch.actions.launch_configurations import ResetLaunchConfigurations, SetLaunchConfiguration
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.substitution import SomeSubstitutionsType
from launch.utilities.arguments import list_like, mapping_like, typed
from launch.utilities.type_utils import is_substitution, perform_typed_substitution

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext


class GroupAction(Action):
    """
    Action that visits others, by default in a scope of launch configurations and environment.

    Parameters
    ----------
    actions
        The actions of the group.
    scoped
        Whether changes of launch configurations and environment end with the group.
    forwarding
        Whether those from outside are forwarded into the scope; otherwise it starts with the
        environment that the launch was started with, and only `launch_configurations`.
    launch_configurations
        Values that are set before the actions, by name.
    **left_over_kwargs
        Keyword arguments of `Action`.

    Raises
    ------
    TypeError
        An argument has the wrong type; the error names it.

    """

    def __init__(
        self,
        actions: Iterable[LaunchDescriptionEntity],
        *,
        scoped: Union[bool, SomeSubstitutionsType] = True,
        forwarding: Union[bool, SomeSubstitutionsType] = True,
        launch_configurations: Optional[
            Mapping[SomeSubstitutionsType, SomeSubstitutionsType]
        ] = None,
        **left_over_kwargs: Any,
    ) -> None:
        super().__init__(**left_over_kwargs)
        self.__actions = list_like('actions', actions, 'actions')
        self.__scoped = typed('scoped', scoped, bool, 'a bool or a substitution')
        self.__forwarding = typed('forwarding', forwarding, bool, 'a bool or a substitution')
        self.__launch_configurations = mapping_like(
            'launch_configurations', launch_configurations or {}
        )
        self.__entities: Optional[list[LaunchDescriptionEntity]] = None

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """
        Read `scoped`, `forwarding`, the children `keep` and the actions of the element `group`.

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
        for name in ('scoped', 'forwarding'):
            value = entity.get_attr(name, data_type=bool, optional=True)
            if value is not None:
                kwargs[name] = parser.parse_if_substitutions(value)
        kwargs['launch_configurations'] = dict(parse_pairs(entity, parser, 'keep'))
        kwargs['actions'] = parser.parse_actions(
            child for child in entity.children if child.type_name != 'keep'
        )
        return cls, kwargs

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the actions, enclosed in those that create the scope if there is one."""
        if self.__entities is None:
            self.__entities = self._around_actions(bool(self.__scoped), bool(self.__forwarding))
        return self.__entities

    def _around_actions(self, scoped: bool, forwarding: bool) -> list[LaunchDescriptionEntity]:
        return self._in_scope(forwarding) if scoped else [*self._settings(), *self.__actions]

    def _settings(self) -> list[LaunchDescriptionEntity]:
        return [
            SetLaunchConfiguration(name, value)
            for name, value in self.__launch_configurations.items()
        ]

    def _in_scope(self, forwarding: bool) -> list[LaunchDescriptionEntity]:
        start: list[LaunchDescriptionEntity] = [PushLaunchConfigurations(), PushEnvironment()]
        if forwarding:
            start += self._settings()
        else:
            start += [ResetEnvironment(), ResetLaunchConfigurations(self.__launch_configurations)]
        return [*start, *self.__actions, PopEnvironment(), PopLaunchConfigurations()]

    def outline(self) -> dict[str, Any]:
        """Return whether the group is scoped, and whether it forwards configurations."""
        return {'scoped': self.__scoped, 'forwarding': self.__forwarding}

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """
        Return the actions to visit next, enclosed in those that create the scope.

        Parameters
        ----------
        context
            The launch context, in which `scoped` and `forwarding` are performed.

        """
        if context.run.observer is not None:
            context.run.observer.note(**self.outline())
        if not is_substitution(self.__scoped) and not is_substitution(self.__forwarding):
            return self.get_sub_entities()
        return self._around_actions(
            perform_typed_substitution(context, self.__scoped, bool),
            perform_typed_substitution(context, self.__forwarding, bool),
        )
