# SPDX-License-Identifier: Apache-2.0
"""Describe a system of processes, launch it and monitor it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import also_found_at, lazy_exports

if TYPE_CHECKING:
    from launch import (
        actions,
        conditions,
        descriptions,
        event_handlers,
        events,
        frontend,
        launch_description_sources,
        logging,
        substitutions,
        utilities,
    )
    from launch.action import Action
    from launch.conditions import Condition
    from launch.event import Event
    from launch.event_handler import EventHandler
    from launch.invalid_launch_file_error import InvalidLaunchFileError
    from launch.launch_context import LaunchContext
    from launch.launch_description import LaunchDescription
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.launch_description_source import LaunchDescriptionSource
    from launch.launch_introspector import LaunchIntrospector
    from launch.launch_service import LaunchService
    from launch.some_entities_type import (
        SomeActionsType,
        SomeActionsType_types_tuple,
        SomeEntitiesType,
        SomeEntitiesType_types_tuple,
    )
    from launch.substitution import (
        SomeSubstitutionsType,
        SomeSubstitutionsType_types_tuple,
        Substitution,
    )

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
    'LaunchIntrospector',
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

# ROS 2 Jazzy has a module for each of them; programs import from those, too.
also_found_at(__name__, 'condition', 'some_actions_type', 'some_substitutions_type')

_ELSEWHERE = {
    'Condition': 'conditions',
    'SomeActionsType': 'some_entities_type',
    'SomeActionsType_types_tuple': 'some_entities_type',
    'SomeEntitiesType_types_tuple': 'some_entities_type',
    'SomeSubstitutionsType': 'substitution',
    'SomeSubstitutionsType_types_tuple': 'substitution',
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
