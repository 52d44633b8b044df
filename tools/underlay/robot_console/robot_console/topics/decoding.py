# SPDX-License-Identifier: Apache-2.0
"""Conversion of serialized messages to text."""

from __future__ import annotations

from functools import cache
from typing import Any

from ros2cli.messages.lookup import get_message
from ros2cli.messages.plain import element_type, Shortening
from ros2cli.messages.text import to_yaml
from ros2topic.api.bandwidth import human_bytes

__all__ = ['decoded', 'has_lists_of_messages']

SHORT = Shortening(length=64)
LONGEST_TEXT = 20_000
MOST_BYTES_FLAT = 32_000_000
MOST_BYTES_NESTED = 300_000


def decoded(raw: bytes, kind: Any) -> str:
    """
    Decode a serialized message to text, truncated if it is long.

    Parameters
    ----------
    raw
        The serialized message.
    kind
        Its message class.

    Returns
    -------
    str
        YAML; for a message that would take too long, an explanation instead.

    """
    from rclpy.serialization import deserialize_message

    most = MOST_BYTES_NESTED if has_lists_of_messages(kind) else MOST_BYTES_FLAT
    if len(raw) > most:
        size, limit = human_bytes(len(raw)), human_bytes(most)
        return f'A message of {size} is not shown as text: that of more than {limit} takes long.'
    text = to_yaml(deserialize_message(raw, kind), SHORT)
    if len(text) > LONGEST_TEXT:
        return f'{text[:LONGEST_TEXT]}\n... ({len(text) - LONGEST_TEXT} letters more)'
    return text


@cache
def has_lists_of_messages(kind: Any) -> bool:
    """
    Check whether a message class contains lists of messages at any depth, which decode slowly.

    Parameters
    ----------
    kind
        The message class.

    """
    for field_type in kind.get_fields_and_field_types().values():
        inner = element_type(field_type)
        if '/' in inner and (inner != field_type or has_lists_of_messages(get_message(inner))):
            return True
    return False
