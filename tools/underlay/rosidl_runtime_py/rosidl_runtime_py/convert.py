# SPDX-License-Identifier: Apache-2.0
"""Messages as dictionaries, YAML and comma-separated values."""

from __future__ import annotations

from collections import OrderedDict
from typing import Any

from ros2cli.messages.text import Shortening, to_csv, to_plain, to_yaml

__all__ = ['message_to_csv', 'message_to_ordereddict', 'message_to_yaml']


def message_to_ordereddict(
    msg: Any,
    *,
    truncate_length: int | None = None,
    no_arr: bool = False,
    no_str: bool = False,
) -> OrderedDict[str, Any]:
    """
    Convert a message to a dictionary of plain Python values, in the order of its fields.

    Parameters
    ----------
    msg
        The message.
    truncate_length
        The longest strings and arrays that are not cut; None for no limit.
    no_arr, no_str
        Whether to put descriptions in place of arrays, and of strings.

    """
    plain: OrderedDict[str, Any] = _ordered(to_plain(msg, _short(truncate_length, no_arr, no_str)))
    return plain


def message_to_yaml(
    msg: Any,
    *,
    truncate_length: int | None = None,
    no_arr: bool = False,
    no_str: bool = False,
    flow_style: bool = False,
) -> str:
    """
    Convert a message to YAML.

    Parameters
    ----------
    msg, truncate_length, no_arr, no_str
        As for `message_to_ordereddict`.
    flow_style
        Whether to write it on one line.

    """
    return to_yaml(msg, _short(truncate_length, no_arr, no_str), flow_style=flow_style)


def message_to_csv(
    msg: Any,
    *,
    truncate_length: int | None = None,
    no_arr: bool = False,
    no_str: bool = False,
) -> str:
    """
    Convert a message to the values of all its fields, with commas between them.

    Parameters
    ----------
    msg, truncate_length, no_arr, no_str
        As for `message_to_ordereddict`.

    """
    return to_csv(msg, _short(truncate_length, no_arr, no_str))


def _short(length: int | None, no_arr: bool, no_str: bool) -> Shortening:
    return Shortening(length, no_arr, no_str)


def _ordered(plain: Any) -> Any:
    if isinstance(plain, dict):
        return OrderedDict((name, _ordered(value)) for name, value in plain.items())
    if isinstance(plain, list):
        return [_ordered(value) for value in plain]
    return plain
