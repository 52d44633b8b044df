# SPDX-License-Identifier: Apache-2.0
"""Types of one or more entities: of a launch description, and as the reaction to an event."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Union

from launch.launch_description_entity import LaunchDescriptionEntity

SomeEntitiesType = Union[LaunchDescriptionEntity, Iterable[LaunchDescriptionEntity]]
SomeActionsType = SomeEntitiesType

SomeEntitiesType_types_tuple = (LaunchDescriptionEntity, Iterable)
SomeActionsType_types_tuple = SomeEntitiesType_types_tuple
