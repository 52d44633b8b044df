# SPDX-License-Identifier: Apache-2.0
"""Conversion between dotted parameter names and nested mappings."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

SEPARATOR = '.'


def nest(values: Mapping[str, Any]) -> dict[str, Any]:
    """
    Nest values by their dotted names: `a.b` becomes `b` within `a`.

    A name stays as it is if one of its prefixes is a parameter itself.

    Parameters
    ----------
    values
        The values by their dotted names.

    """
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
    """
    Flatten nested mappings into dotted names.

    Parameters
    ----------
    nested
        Values or mappings by name; mappings may be nested to any depth.
    prefix
        The prefix of each name, with its final dot.

    Yields
    ------
    tuple of str and Any
        A dotted name and its value.

    """
    for name, value in nested.items():
        if isinstance(value, Mapping):
            yield from flatten(value, f'{prefix}{name}{SEPARATOR}')
        else:
            yield f'{prefix}{name}', value
