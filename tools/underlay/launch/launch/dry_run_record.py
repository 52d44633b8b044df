# SPDX-License-Identifier: Apache-2.0
"""
What a dry run observes: the record of one action, as data and as text.

As data (`ros2 launch --dry-run --json`) each action has these keys; those that do not apply are
left out, and new ones may be added:

action      the name of its class; `launch` for the root, which also has `status`
error       of the root: the error message
file, line  where the launch file creates it
condition   expression, expanded (text or null) and value (true, false; null: not known yet)
actions     the list of actions visited below it
waiting     a list of `for`, a description of an event, and `actions`, described but not visited
name, value, is_default, text, path, namespace, function, scoped, forwarding, reason, event,
source, target
            the values that the action sets, logs, includes, calls or emits
label, argv, shell, cwd, environment
            of a process; the environment has the differences to that of the launcher (null: unset)
transition  of the event ChangeState
command     of a process that waits: the descriptions of its words
node_name, node_namespace, parameter_files, parameters, remappings
            of a node; the parameters are those that it sees, from all files and dictionaries
target_container, composable_nodes
            the container, and for each loaded node package, plugin and the keys of a node
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from itertools import chain
import os
import shlex
import textwrap
from typing import Any, Optional

from launch.failures import CallSite

_WIDTH = 80
_STEP = '  '
_USUAL = ('scoped', 'forwarding')
_TEXTS = ('environment', 'remappings')
_LONG = 200
_IN_THE_HEAD = (
    *('label', 'path', 'text', 'name', 'value', 'is_default', 'namespace', 'function'),
    *('reason', 'event'),
)


@dataclass
class ConditionRecord:
    """A condition: its expression, the expanded text, and the value (None: not known yet)."""

    expression: str
    expanded: Optional[str]
    value: Optional[bool]


@dataclass
class Record:
    """Record of an action, with its facts, children and waiting entities."""

    action: str
    call_site: Optional[CallSite] = None
    condition: Optional[ConditionRecord] = None
    facts: dict[str, Any] = field(default_factory=dict)
    children: list[Record] = field(default_factory=list)
    waiting: list[tuple[str, list[Record]]] = field(default_factory=list)

    def as_data(self) -> dict[str, Any]:
        """Return the record as plain data, with the keys listed in the module docstring."""
        data: dict[str, Any] = {'action': self.action}
        if self.call_site is not None:
            data.update(file=self.call_site.file_name, line=self.call_site.line)
        if self.condition is not None:
            data['condition'] = dict(vars(self.condition))
        data.update(self.facts)
        if self.children:
            data['actions'] = [each.as_data() for each in self.children]
        if self.waiting:
            data['waiting'] = [
                {'for': event, 'actions': [each.as_data() for each in records]}
                for event, records in self.waiting
            ]
        return data


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
    answer = 'true' if condition.value else 'false, so it is skipped'
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
