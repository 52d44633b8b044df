# SPDX-License-Identifier: Apache-2.0
"""How the panel of recordings says things."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from datetime import datetime

from robot_console.recordings.shelf import Bag
from ros2bag.api.info import human_size
from rviz_common.panels.marks import escaped

__all__ = ['about', 'clock_text', 'listed', 'memory_text', 'mixture_text', 'size_text']

NAMED = 4
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


def about(bag: Bag) -> tuple[str, str]:
    """Return what there is to say about a recording, and about its topics, as Markdown."""
    if bag.problem:
        return f'✖ {escaped(bag.problem)}', ''
    start = datetime.fromtimestamp(bag.start_s).strftime('%Y-%m-%d %H:%M:%S')
    head = (
        f'{clock_text(bag.duration_s)} from {start}: {bag.message_count} messages, '
        f'{size_text(bag.size_bytes)}'
    )
    rows = ''.join(
        f'\n| {escaped(each.name)} | {escaped(each.type_name)} | {each.message_count} |'
        for each in bag.topics
    )
    return head, f'| Topic | Type | Messages |\n|---|---|---:|{rows}'


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
