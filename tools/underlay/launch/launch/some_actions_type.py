# SPDX-License-Identifier: Apache-2.0
"""Type of one or more entities that are given as the reaction to an event."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Union

from launch.launch_description_entity import LaunchDescriptionEntity

SomeActionsType = Union[LaunchDescriptionEntity, Iterable[LaunchDescriptionEntity]]

SomeActionsType_types_tuple = (LaunchDescriptionEntity, Iterable)
