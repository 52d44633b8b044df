# SPDX-License-Identifier: Apache-2.0
"""The action that groups others."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, Optional, TYPE_CHECKING

from launch._checked import list_like, mapping_like
from launch.action import Action
from launch.actions.pop_environment import PopEnvironment
from launch.actions.pop_launch_configurations import PopLaunchConfigurations
from launch.actions.push_environment import PushEnvironment
from launch.actions.push_launch_configurations import PushLaunchConfigurations
from launch.actions.reset_environment import ResetEnvironment
from launch.actions.reset_launch_configurations import ResetLaunchConfigurations
from launch.actions.set_launch_configuration import SetLaunchConfiguration
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.some_substitutions_type import SomeSubstitutionsType

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class GroupAction(Action):
    """Visits actions, by default in a scope of launch configurations and environment."""

    def __init__(
        self,
        actions: Iterable[LaunchDescriptionEntity],
        *,
        scoped: bool = True,
        forwarding: bool = True,
        launch_configurations: Optional[
            Mapping[SomeSubstitutionsType, SomeSubstitutionsType]
        ] = None,
        **left_over_kwargs: Any,
    ) -> None:
        """Create the group; without `forwarding` only `launch_configurations` get into it."""
        super().__init__(**left_over_kwargs)
        self.__actions = list_like('actions', actions, 'actions')
        self.__scoped = scoped
        self.__forwarding = forwarding
        self.__launch_configurations = mapping_like(
            'launch_configurations', launch_configurations or {}
        )
        self.__entities: Optional[list[LaunchDescriptionEntity]] = None

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the actions, with those around them that make the scope."""
        if self.__entities is None:
            self.__entities = (
                self._in_scope() if self.__scoped else [*self._settings(), *self.__actions]
            )
        return self.__entities

    def _settings(self) -> list[LaunchDescriptionEntity]:
        return [
            SetLaunchConfiguration(name, value)
            for name, value in self.__launch_configurations.items()
        ]

    def _in_scope(self) -> list[LaunchDescriptionEntity]:
        start: list[LaunchDescriptionEntity] = [PushLaunchConfigurations(), PushEnvironment()]
        if self.__forwarding:
            start += self._settings()
        else:
            start += [ResetEnvironment(), ResetLaunchConfigurations(self.__launch_configurations)]
        return [*start, *self.__actions, PopEnvironment(), PopLaunchConfigurations()]

    def _outline(self) -> dict[str, Any]:
        return {'scoped': self.__scoped, 'forwarding': self.__forwarding}

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Return the actions, which are visited next."""
        if context._observer is not None:
            context._observer.note(**self._outline())
        return self.get_sub_entities()
