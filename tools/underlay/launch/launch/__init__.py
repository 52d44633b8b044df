# SPDX-License-Identifier: Apache-2.0
"""Describe a system of processes, start it and watch over it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ._lazy import lazy_exports

if TYPE_CHECKING:
    from . import actions as actions
    from . import conditions as conditions
    from . import descriptions as descriptions
    from . import event_handlers as event_handlers
    from . import events as events
    from . import frontend as frontend
    from . import launch_description_sources as launch_description_sources
    from . import logging as logging
    from . import substitutions as substitutions
    from . import utilities as utilities
    from .action import Action as Action
    from .condition import Condition as Condition
    from .event import Event as Event
    from .event_handler import EventHandler as EventHandler
    from .invalid_launch_file_error import InvalidLaunchFileError as InvalidLaunchFileError
    from .launch_context import LaunchContext as LaunchContext
    from .launch_description import LaunchDescription as LaunchDescription
    from .launch_description_entity import LaunchDescriptionEntity as LaunchDescriptionEntity
    from .launch_description_source import LaunchDescriptionSource as LaunchDescriptionSource
    from .launch_service import LaunchService as LaunchService
    from .some_actions_type import SomeActionsType as SomeActionsType
    from .some_actions_type import SomeActionsType_types_tuple as SomeActionsType_types_tuple
    from .some_entities_type import SomeEntitiesType as SomeEntitiesType
    from .some_entities_type import SomeEntitiesType_types_tuple as SomeEntitiesType_types_tuple
    from .some_substitutions_type import SomeSubstitutionsType as SomeSubstitutionsType
    from .some_substitutions_type import (
        SomeSubstitutionsType_types_tuple as SomeSubstitutionsType_types_tuple,
    )
    from .substitution import Substitution as Substitution

__all__ = [
    'Action',
    'Condition',
    'Event',
    'EventHandler',
    'InvalidLaunchFileError',
    'LaunchContext',
    'LaunchDescription',
    'LaunchDescriptionEntity',
    'LaunchDescriptionSource',
    'LaunchService',
    'SomeActionsType',
    'SomeActionsType_types_tuple',
    'SomeEntitiesType',
    'SomeEntitiesType_types_tuple',
    'SomeSubstitutionsType',
    'SomeSubstitutionsType_types_tuple',
    'Substitution',
    'actions',
    'conditions',
    'descriptions',
    'event_handlers',
    'events',
    'frontend',
    'launch_description_sources',
    'logging',
    'substitutions',
    'utilities',
]

_ELSEWHERE = {
    'SomeActionsType_types_tuple': 'some_actions_type',
    'SomeEntitiesType_types_tuple': 'some_entities_type',
    'SomeSubstitutionsType_types_tuple': 'some_substitutions_type',
    'actions': '',
    'conditions': '',
    'descriptions': '',
    'event_handlers': '',
    'events': '',
    'frontend': '',
    'launch_description_sources': '',
    'logging': '',
    'substitutions': '',
    'utilities': '',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)
