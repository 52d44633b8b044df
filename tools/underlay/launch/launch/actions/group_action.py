# SPDX-License-Identifier: Apache-2.0
"""The action that groups others."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, List, Optional, TYPE_CHECKING

from .pop_environment import PopEnvironment
from .pop_launch_configurations import PopLaunchConfigurations
from .push_environment import PushEnvironment
from .push_launch_configurations import PushLaunchConfigurations
from .reset_environment import ResetEnvironment
from .reset_launch_configurations import ResetLaunchConfigurations
from .set_launch_configuration import SetLaunchConfiguration
from ..action import Action
from ..launch_description_entity import LaunchDescriptionEntity
from ..some_substitutions_type import SomeSubstitutionsType

if TYPE_CHECKING:
    from ..launch_context import LaunchContext


class GroupAction(Action):
    """Visits actions, by default in a scope of launch configurations and environment."""

    def __init__(
        self,
        actions: Iterable[LaunchDescriptionEntity],
        *,
        scoped: bool = True,
        forwarding: bool = True,
        launch_configurations: Optional[
            Mapping[SomeSubstitutionsType, SomeSubstitutionsType]] = None,
        **left_over_kwargs: Any,
    ) -> None:
        """Create the group; without `forwarding` only `launch_configurations` get into it."""
        super().__init__(**left_over_kwargs)
        self.__actions = list(actions)
        self.__scoped = scoped
        self.__forwarding = forwarding
        self.__launch_configurations = dict(launch_configurations or {})
        self.__entities: Optional[List[LaunchDescriptionEntity]] = None

    def get_sub_entities(self) -> List[LaunchDescriptionEntity]:
        """Return the actions, with those around them that make the scope."""
        if self.__entities is None:
            self.__entities = self._in_scope() if self.__scoped else [
                *self._settings(), *self.__actions]
        return self.__entities

    def _settings(self) -> List[LaunchDescriptionEntity]:
        return [SetLaunchConfiguration(name, value)
                for name, value in self.__launch_configurations.items()]

    def _in_scope(self) -> List[LaunchDescriptionEntity]:
        start: List[LaunchDescriptionEntity] = [PushLaunchConfigurations(), PushEnvironment()]
        if self.__forwarding:
            start += self._settings()
        else:
            start += [ResetEnvironment(), ResetLaunchConfigurations(self.__launch_configurations)]
        return [*start, *self.__actions, PopEnvironment(), PopLaunchConfigurations()]

    def execute(self, context: LaunchContext) -> List[LaunchDescriptionEntity]:
        """Return the actions, which are visited next."""
        return self.get_sub_entities()
