# SPDX-License-Identifier: Apache-2.0
"""Between the dotted names of parameters and nested mappings."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

SEPARATOR = '.'


def nest(values: Mapping[str, Any]) -> dict[str, Any]:
    """Return a mapping in which `a.b` is `b` within `a`, unless `a` is a parameter itself."""
    root: dict[str, Any] = {}
    for name, value in values.items():
        parts = name.split(SEPARATOR)
        prefixes = {SEPARATOR.join(parts[:count]) for count in range(1, len(parts))}
        if prefixes & values.keys():
            root[name] = value
            continue
        inner = root
        for part in parts[:-1]:
            inner = inner.setdefault(part, {})
        inner[parts[-1]] = value
    return root


def flatten(nested: Mapping[Any, Any], prefix: str = '') -> Iterator[tuple[str, Any]]:
    """Yield the dotted names of nested values, with the values."""
    for name, value in nested.items():
        if isinstance(value, Mapping):
            yield from flatten(value, f'{prefix}{name}{SEPARATOR}')
        else:
            yield f'{prefix}{name}', value
