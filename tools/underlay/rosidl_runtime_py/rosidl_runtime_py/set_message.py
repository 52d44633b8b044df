# SPDX-License-Identifier: Apache-2.0
"""Fields of messages set from plain Python values."""

from __future__ import annotations

import array
from collections.abc import Mapping
from typing import Any

import numpy as np
from ros2cli.messages.text import element_type
from rosidl_runtime_py.utilities import get_message

__all__ = ['set_message_fields']


def set_message_fields(msg: Any, values: Mapping[str, Any]) -> None:
    """
    Set fields of a message, and those of the messages in it.

    Parameters
    ----------
    msg
        The message.
    values
        Plain values by the names of fields, such as from YAML. Other fields stay as they are.

    Raises
    ------
    AttributeError
        The message has no such field.
    TypeError, ValueError, AssertionError
        A value is not one for its field.

    """
    if not isinstance(values, Mapping):
        raise TypeError(f'Expected values by the names of fields, got {values!r}')
    types = msg.get_fields_and_field_types()
    for name, value in values.items():
        setattr(msg, name, _converted(getattr(msg, name), value, types.get(name, '')))


def _converted(present: Any, value: Any, field_type: str) -> Any:
    if hasattr(present, 'get_fields_and_field_types'):
        if isinstance(value, type(present)):
            return value
        set_message_fields(present, value)
        return present
    if isinstance(present, np.ndarray):
        return np.array(value, present.dtype)
    if isinstance(present, array.array):
        return array.array(present.typecode, value)
    if isinstance(present, list):
        return [_element(each, element_type(field_type)) for each in value]
    return type(present)(value) if isinstance(present, (int, float, str)) else value


def _element(value: Any, kind: str) -> Any:
    if '/' not in kind or not isinstance(value, Mapping):
        return value
    package, name = kind.split('/')[0], kind.split('/')[-1]
    msg = get_message(f'{package}/msg/{name}')()
    set_message_fields(msg, value)
    return msg
