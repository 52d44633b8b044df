# SPDX-License-Identifier: Apache-2.0
"""How the panel of recordings says things."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from datetime import datetime
from html import escape

from robot_console.recordings.shelf import Bag, BagTopic
from ros2bag.api.info import human_size
from rviz_common.panels.marks import escaped

__all__ = [
    'about',
    'clock_text',
    'listed',
    'memory_text',
    'mixture_text',
    'size_text',
    'topics_table',
]

NAMED = 4
TABLE = 'width: 100%; font-size: 0.8em; overflow-wrap: anywhere; padding: 0 0.5em'
size_text = human_size


def clock_text(seconds: float) -> str:
    """Return a duration as people read it: 7.5 s, 12:30, 1:02:03."""
    if seconds < 60:
        return f'{seconds:.1f} s'
    minutes, rest = divmod(int(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f'{hours}:{minutes:02d}:{rest:02d}' if hours else f'{minutes}:{rest:02d}'


def listed(names: Iterable[str], most: int = NAMED) -> str:
    """Return some names, and how many more there are."""
    names = list(names)
    text = ', '.join(names[:most])
    return f'{text} and {len(names) - most} more' if len(names) > most else text


def about(bag: Bag) -> str:
    """Return what there is to say about a recording, as Markdown."""
    if bag.problem:
        return f'✖ {escaped(bag.problem)}'
    start = datetime.fromtimestamp(bag.start_s).strftime('%Y-%m-%d %H:%M:%S')
    return (
        f'{start}, {clock_text(bag.duration_s)}, {bag.message_count} messages, '
        f'{size_text(bag.size_bytes)}'
    )


def topics_table(topics: Iterable[BagTopic]) -> str:
    """Return a table of topics with their types, as HTML that is not wider than its place."""
    rows = ''.join(
        f'<tr style="vertical-align: top"><td style="padding-bottom: 0.3em">{escape(each.name)}'
        f'<br><span style="opacity: 0.6">{escape(each.type_name)}</span></td>'
        f'<td style="text-align: right">{escape(str(each.message_count))}</td></tr>'
        for each in topics
    )
    return f'<table style="{TABLE}"><tbody>{rows}</tbody></table>'


def memory_text(facts: Mapping[str, object], wanted_s: float, max_mib: float) -> str:
    """Return what is kept of the last seconds."""
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
    """Return what is wrong if others publish what is being played, otherwise ''."""
    if not publishers:
        return ''
    nodes = sorted({name for names in publishers.values() for name in names})
    verb = 'publish' if len(nodes) > 1 else 'publishes'
    return (
        f'{listed(nodes)} {verb} {listed(sorted(publishers))} as well: what is shown is a mixture '
        'of recorded and live. End what is live, or play without it.'
    )
