# SPDX-License-Identifier: Apache-2.0
"""What stands for one or more entities given as the reaction to an event."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Union

from launch.launch_description_entity import LaunchDescriptionEntity

SomeActionsType = Union[LaunchDescriptionEntity, Iterable[LaunchDescriptionEntity]]

SomeActionsType_types_tuple = (LaunchDescriptionEntity, Iterable)
