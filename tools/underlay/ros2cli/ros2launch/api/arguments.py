# SPDX-License-Identifier: Apache-2.0
"""The arguments `name:=value` of a launch file."""

from __future__ import annotations

from collections.abc import Sequence

SEPARATOR = ':='


def parse_launch_arguments(texts: Sequence[str]) -> list[tuple[str, str]]:
    """Return names and values in the order of the command line; the last of a name wins."""
    values: dict[str, str] = {}
    for text in texts:
        name, separator, value = text.partition(SEPARATOR)
        if not (separator and name and value):
            raise RuntimeError(
                f"malformed launch argument '{text}', expected format '<name>:=<value>'"
            )
        values[name] = value
    return list(values.items())
