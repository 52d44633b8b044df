# SPDX-License-Identifier: Apache-2.0
"""The arguments `name:=value` of a launch file."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

SEPARATOR = ':='
SIMILARITY = 0.8


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


def misspelt_argument_text(given: Iterable[str], declared: Iterable[str]) -> str:
    """Return the error text about a name that is not declared but close to one that is."""
    from difflib import get_close_matches

    known = list(declared)
    for name in given:
        close = [] if name in known else get_close_matches(name, known, 1, SIMILARITY)
        if close:
            return (
                f"the launch file does not declare an argument '{name}'. "
                f"Did you mean '{close[0]}'? Pass --allow-unknown-args if "
                f"'{name}' is meant, or --show-args to see the arguments"
            )
    return ''
