# SPDX-License-Identifier: Apache-2.0
"""The arguments `name:=value` of a launch file."""

from __future__ import annotations

from collections.abc import Sequence

SEPARATOR = ':='


def parse_launch_arguments(texts: Sequence[str]) -> list[tuple[str, str]]:
    """
    Parse launch arguments of the form `name:=value`.

    Parameters
    ----------
    texts
        The arguments as given on the command line.

    Returns
    -------
    list of tuple
        Name and value of each argument, in the order of the names' first use; the last value of a
        name counts.

    Raises
    ------
    RuntimeError
        An argument is not of this form, or its name or value is empty.

    """
    values: dict[str, str] = {}
    for text in texts:
        name, separator, value = text.partition(SEPARATOR)
        if not (separator and name and value):
            raise RuntimeError(
                f"malformed launch argument '{text}', expected format '<name>:=<value>'"
            )
        values[name] = value
    return list(values.items())
