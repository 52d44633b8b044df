# SPDX-License-Identifier: Apache-2.0
"""Lookup of installed message types and their fields."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Any

from robot_console.plots.field_path import PathError

__all__ = ['fields_of', 'message_class']


@cache
def message_class(type_name: str) -> Any:
    """
    Import the class of a message type.

    Parameters
    ----------
    type_name
        For example `std_msgs/msg/String`.

    Raises
    ------
    PathError
        The type is not installed, or cannot be imported.

    """
    from ros2cli.messages.lookup import get_message, UnknownType

    try:
        return get_message(type_name)
    except UnknownType as error:
        raise PathError(f'{type_name} cannot be read: {error}.') from error


@cache
def fields_of(type_name: str) -> Mapping[str, str]:
    """
    Return the fields of a message type.

    Parameters
    ----------
    type_name
        For example `std_msgs/msg/String`.

    Returns
    -------
    Mapping
        The field types in IDL notation, such as `sequence<double>`, by field name.

    Raises
    ------
    PathError
        As for `message_class`.

    """
    fields: Mapping[str, str] = message_class(type_name).get_fields_and_field_types()
    return fields
