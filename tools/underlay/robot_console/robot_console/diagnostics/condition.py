# SPDX-License-Identifier: Apache-2.0
"""Diagnostic status of one component of a robot."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ['ERROR', 'OK', 'STALE', 'WARN', 'Condition', 'condition']

OK, WARN, ERROR, STALE = range(4)
LONGEST = 500
MOST_VALUES = 200


class Condition(NamedTuple):
    """Diagnostic status of a component, with a level of diagnostic_msgs."""

    level: int
    message: str
    hardware: str = ''
    values: tuple[tuple[str, str], ...] = ()


def condition(level: int, message: str, hardware: str, values: list[tuple[str, str]]) -> Condition:
    """
    Convert a diagnostic status to a `Condition`, truncating long texts.

    Parameters
    ----------
    level
        The level of diagnostic_msgs, from `OK` to `STALE`; any other counts as `ERROR`.
    message
        The message of the component.
    hardware
        The hardware id.
    values
        Key-value pairs; only the first 200 are kept.

    """
    if level not in (OK, WARN, ERROR, STALE):
        message = f'{message} (it says level {level}, which does not exist)'.strip()
        level = ERROR
    pairs = [(_short(key), _short(value)) for key, value in values[:MOST_VALUES]]
    if len(values) > MOST_VALUES:
        pairs.append(('...', f'{len(values) - MOST_VALUES} more values'))
    return Condition(level, _short(message), _short(hardware), tuple(pairs))


def _short(text: str) -> str:
    return text if len(text) <= LONGEST else f'{text[:LONGEST]} ...'
