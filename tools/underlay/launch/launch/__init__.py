# SPDX-License-Identifier: Apache-2.0
"""Describe a system of processes, start it and watch over it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ._lazy import lazy_exports

if TYPE_CHECKING:
    from . import actions
    from . import conditions
    from . import descriptions
    from . import event_handlers
    from . import events
    from . import frontend
    from . import launch_description_sources
    from . import logging
    from . import substitutions
    from . import utilities
    from .action import Action
    from .condition import Condition
    from .event import Event
    from .event_handler import EventHandler
    from .invalid_launch_file_error import InvalidLaunchFileError
    from .launch_context import LaunchContext
    from .launch_description import LaunchDescription
    from .launch_description_entity import LaunchDescriptionEntity
    from .launch_description_source import LaunchDescriptionSource
    from .launch_service import LaunchService
    from .some_actions_type import SomeActionsType
    from .some_actions_type import SomeActionsType_types_tuple
    from .some_entities_type import SomeEntitiesType
    from .some_entities_type import SomeEntitiesType_types_tuple
    from .some_substitutions_type import SomeSubstitutionsType
    from .some_substitutions_type import SomeSubstitutionsType_types_tuple
    from .substitution import Substitution

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
