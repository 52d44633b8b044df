# SPDX-License-Identifier: Apache-2.0
"""Messages as YAML and as comma separated values."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ros2cli.messages.plain import Shortening, to_plain
import yaml

Dumper: Any = getattr(yaml, 'CSafeDumper', yaml.SafeDumper)
UNLIMITED_WIDTH = 2**31 - 1


def to_yaml(value: Any, shortening: Shortening = Shortening(), *, flow_style: bool = False) -> str:
    """Return a message as YAML, one field a line unless flow style is wanted."""
    plain = to_plain(value, shortening)
    text: str = yaml.dump(
        plain,
        Dumper=Dumper,
        allow_unicode=True,
        sort_keys=False,
        width=UNLIMITED_WIDTH,
        default_flow_style=flow_style,
    )
    return text


def to_csv(value: Any, shortening: Shortening = Shortening()) -> str:
    """Return the values of all fields, depth first, with commas between them."""
    return ','.join(str(leaf) for leaf in _leaves(to_plain(value, shortening)))


def _leaves(plain: Any) -> Iterator[Any]:
    if isinstance(plain, dict):
        plain = list(plain.values())
    if not isinstance(plain, list):
        yield plain
        return
    for item in plain:
        yield from _leaves(item)
