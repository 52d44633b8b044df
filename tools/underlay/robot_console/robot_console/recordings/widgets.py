# SPDX-License-Identifier: Apache-2.0
"""What the widgets of the recordings panel say, and their update without needless messages."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from ros2bag.verb.info import human_size

__all__ = [
    'assign',
    'clock_text',
    'listed',
    'memory_text',
    'mixture_text',
    'size_text',
]

NAMED = 4
size_text = human_size


def assign(widget: Any, **values: Any) -> None:
    """
    Set properties of a widget, skipping those that already have the value.

    viser sends every assignment to all browsers, changed or not.

    Parameters
    ----------
    widget
        A viser widget.
    **values
        The new values, by the name of the property.

    """
    for name, value in values.items():
        if getattr(widget, name) != value:
            setattr(widget, name, value)


def clock_text(seconds: float) -> str:
    """
    Format a duration: 7.5 s, 12:30, 1:02:03.

    Parameters
    ----------
    seconds
        The duration, in s.

    """
    if seconds < 60:
        return f'{seconds:.1f} s'
    minutes, rest = divmod(int(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f'{hours}:{minutes:02d}:{rest:02d}' if hours else f'{minutes}:{rest:02d}'


def listed(names: Iterable[str], most: int = NAMED) -> str:
    """
    Join names with commas, and replace surplus names by their count.

    Parameters
    ----------
    names
        The names.
    most
        The maximum number of names in the text.

    """
    names = list(names)
    text = ', '.join(names[:most])
    return f'{text} and {len(names) - most} more' if len(names) > most else text


def memory_text(facts: Mapping[str, object], wanted_s: float, max_mib: float) -> str:
    """
    Describe the contents of the message buffer.

    Parameters
    ----------
    facts
        The facts reported by the program `remember`; may be empty.
    wanted_s
        The duration to keep, in s.
    max_mib
        The memory limit, in MiB.

    """
    if 'seconds' not in facts:
        return 'Starting ...'
    seconds = min(float(str(facts['seconds'])), wanted_s)
    size = size_text(float(str(facts['size_bytes'])))
    text = (
        f'Keeps {seconds:.0f} s: {facts["messages"]} messages of {facts["topics"]} topics, {size}.'
    )
    if facts.get('is_short'):
        text += f' ⚠ Not the whole {wanted_s:g} s: no more than {max_mib:g} MiB are kept.'
    return text


def mixture_text(publishers: Mapping[str, Iterable[str]]) -> str:
    """
    Warn that live nodes publish on topics that are being played.

    Parameters
    ----------
    publishers
        The names of these nodes, by topic.

    Returns
    -------
    str
        The warning; '' if there are no such nodes.

    """
    if not publishers:
        return ''
    nodes = sorted({name for names in publishers.values() for name in names})
    verb = 'publish' if len(nodes) > 1 else 'publishes'
    return (
        f'{listed(nodes)} {verb} {listed(sorted(publishers))} as well: the display mixes '
        'recorded and live data. Stop the live nodes, or play without these topics.'
    )
