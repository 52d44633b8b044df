# SPDX-License-Identifier: Apache-2.0
"""The fields of the types of messages that are installed."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Any

from robot_console.plots.field_path import PathError

__all__ = ['fields_of', 'message_class']


@cache
def message_class(type_name: str) -> Any:
    """Return the class of a type such as `std_msgs/msg/String`, or raise PathError."""
    from ros2cli.messages.lookup import get_message, UnknownType

    try:
        return get_message(type_name)
    except UnknownType as error:
        raise PathError(f'{type_name} cannot be read: {error}.') from error


@cache
def fields_of(type_name: str) -> Mapping[str, str]:
    """Return the fields of a type of messages with their types."""
    fields: Mapping[str, str] = message_class(type_name).get_fields_and_field_types()
    return fields
