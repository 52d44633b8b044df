# SPDX-License-Identifier: Apache-2.0
"""Messages as YAML and as comma separated values."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ros2cli.messages.block_yaml import dump, NeedsPyYaml, to_block_yaml
from ros2cli.messages.plain import Shortening, to_plain


def to_yaml(value: Any, shortening: Shortening = Shortening(), *, flow_style: bool = False) -> str:
    """Return a message as YAML, one field a line unless flow style is wanted."""
    return plain_to_yaml(to_plain(value, shortening), flow_style=flow_style)


def plain_to_yaml(plain: Any, *, flow_style: bool = False) -> str:
    """Return plain values as YAML, in the fast way where that is possible."""
    if flow_style:
        return dump(plain, flow_style=True)
    try:
        return to_block_yaml(plain)
    except NeedsPyYaml:
        return dump(plain, flow_style=False)


def to_csv(value: Any, shortening: Shortening = Shortening()) -> str:
    """Return the values of all fields, depth first, with commas between them."""
    return plain_to_csv(to_plain(value, shortening))


def plain_to_csv(plain: Any) -> str:
    """Return plain values, depth first, with commas between them."""
    return ','.join(str(leaf) for leaf in _leaves(plain))


def _leaves(plain: Any) -> Iterator[Any]:
    if isinstance(plain, dict):
        plain = list(plain.values())
    if not isinstance(plain, list):
        yield plain
        return
    for item in plain:
        yield from _leaves(item)
