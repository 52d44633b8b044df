# SPDX-License-Identifier: Apache-2.0
"""Serialization of messages to YAML and comma-separated values."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ros2cli.messages.block_yaml import dump, NeedsPyYaml, to_block_yaml
from ros2cli.messages.plain import Shortening, to_plain


def to_yaml(value: Any, shortening: Shortening = Shortening(), *, flow_style: bool = False) -> str:
    """
    Serialize a message to YAML.

    Parameters
    ----------
    value
        The message.
    shortening
        Maximum lengths of strings and arrays.
    flow_style
        Whether to write it on one line instead of one field per line.

    """
    return plain_to_yaml(to_plain(value, shortening), flow_style=flow_style)


def plain_to_yaml(plain: Any, *, flow_style: bool = False) -> str:
    """
    Serialize plain values to YAML, without PyYAML where that is possible.

    Parameters
    ----------
    plain
        Mappings, lists, numbers and strings.
    flow_style
        Whether to write it on one line.

    """
    if flow_style:
        return dump(plain, flow_style=True)
    try:
        return to_block_yaml(plain)
    except NeedsPyYaml:
        return dump(plain, flow_style=False)


def to_csv(value: Any, shortening: Shortening = Shortening()) -> str:
    """
    Serialize the values of all fields of a message, depth first, with commas between them.

    Parameters
    ----------
    value
        The message.
    shortening
        Maximum lengths of strings and arrays.

    """
    return plain_to_csv(to_plain(value, shortening))


def plain_to_csv(plain: Any) -> str:
    """
    Serialize plain values, depth first, with commas between them.

    Parameters
    ----------
    plain
        Mappings, lists, numbers and strings; nothing is quoted.

    """
    return ','.join(str(leaf) for leaf in _leaves(plain))


def _leaves(plain: Any) -> Iterator[Any]:
    if isinstance(plain, dict):
        plain = list(plain.values())
    if not isinstance(plain, list):
        yield plain
        return
    for item in plain:
        yield from _leaves(item)
