# SPDX-License-Identifier: Apache-2.0
"""Format the records of a dry run as human-readable text."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import chain
import os
import shlex
import textwrap
from typing import Any, Optional

from launch._call_site import CallSite
from launch._rehearsal.record import ConditionRecord, Record

_WIDTH = 80
_STEP = '  '
_USUAL = ('scoped', 'forwarding')
_TEXTS = ('environment', 'remappings')
_LONG = 200
_IN_THE_HEAD = (
    *('label', 'path', 'text', 'name', 'value', 'is_default', 'namespace', 'function'),
    *('reason', 'event'),
)


def tree_lines(record: Record) -> Iterator[str]:
    """
    Format the records of a dry run as lines of text.

    Parameters
    ----------
    record
        The record whose children are formatted, at any depth.

    Returns
    -------
    iterator of str
        The lines, wrapped at 80 columns where words allow it.

    """
    return chain.from_iterable(_lines(each, '') for each in record.children)


def _lines(record: Record, indent: str) -> Iterator[str]:
    yield from _wrapped(_head(record), indent)
    inner = indent + _STEP
    if record.condition is not None:
        yield from _wrapped(_condition(record.condition), inner)
    for name, value in record.facts.items():
        if name not in _IN_THE_HEAD:
            yield from _fact(name, value, inner)
    for child in record.children:
        yield from _lines(child, inner)
    for event, records in record.waiting:
        end = ':' if records else '; what follows is not known yet'
        yield from _wrapped(f'waiting for {event}{end}', inner)
        for each in records:
            yield from _lines(each, inner + _STEP)


def _head(record: Record) -> str:
    """Format the head line of an action, with its short facts."""
    place = '' if record.call_site is None else f'  ({_short(record.call_site)})'
    return f'{record.action}{_summary(record.facts)}{place}'


def _summary(facts: Mapping[str, Any]) -> str:
    """Format the value that an action sets, or else its most significant fact."""
    if 'value' in facts:
        default = ' (the default)' if facts.get('is_default') else ''
        return f" {facts['name']} = '{_cut(facts['value'])}'{default}"
    found = next((facts[name] for name in _IN_THE_HEAD if name in facts), None)
    return '' if found is None else f' {_cut(str(found))}'


def _short(call_site: CallSite) -> str:
    return f'{os.path.basename(call_site.file_name)}:{call_site.line}'


def _condition(condition: ConditionRecord) -> str:
    if condition.value is None:
        return f'if {condition.expression}, which is evaluated then'
    answer = 'true' if condition.value else 'false, so it is left out'
    why = '' if condition.expanded is None else f", which expanded to '{condition.expanded}'"
    return f'if {condition.expression}{why}: {answer}'


def _fact(name: str, value: Any, indent: str) -> Iterator[str]:
    """Yield the lines of a fact; none if it is empty or has its usual value."""
    if value is None or value in ({}, []) or (name in _USUAL and value):
        return
    label = name.replace('_', ' ')
    if isinstance(value, Mapping):
        yield f'{indent}{label}:'
        for key, each in value.items():
            text = _variable(key, each) if name in _TEXTS else f'{key}: {_cut(repr(each))}'
            yield from _wrapped(text, indent + _STEP)
    elif isinstance(value, list) and isinstance(value[0], Mapping):
        for each in value:
            yield f'{indent}{label.removesuffix("s")}:'
            for key, inner in each.items():
                yield from _fact(key, inner, indent + _STEP)
    elif isinstance(value, list):
        words = map(shlex.quote, value) if name == 'argv' else map(str, value)
        yield from _wrapped(f'{label}: {" ".join(words)}', indent)
    else:
        yield from _wrapped(f'{label}: {value}', indent)


def _variable(name: str, value: Optional[str]) -> str:
    return f'{name} is not set' if value is None else f'{name} = {_cut(value)}'


def _cut(text: str) -> str:
    """Truncate a string that is too long, such as a robot description."""
    text = ' '.join(text.split())
    return text if len(text) <= _LONG else f'{text[:_LONG]}... ({len(text)} characters)'


def _wrapped(text: str, indent: str) -> list[str]:
    """Wrap a string to the width of a terminal without breaking long words."""
    lines = []
    for line in text.splitlines() or ['']:
        lines += textwrap.wrap(
            line,
            _WIDTH,
            initial_indent=indent,
            subsequent_indent=indent + _STEP * 2,
            break_long_words=False,
            break_on_hyphens=False,
        ) or [indent]
    return lines
