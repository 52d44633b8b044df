# SPDX-License-Identifier: Apache-2.0
"""Paths of numeric message fields, such as `joint_states.position[left_knee]`."""

from __future__ import annotations

from dataclasses import dataclass
import re
from typing import Union

__all__ = ['Element', 'Field', 'FieldPath', 'PathError', 'Step', 'parse_path']

EXAMPLE = 'A path is like joint_states.position[left_knee] or imu.angular_velocity.z.'
TOPIC = re.compile(r'(~/|/)?[A-Za-z_][A-Za-z0-9_]*(/[A-Za-z_][A-Za-z0-9_]*)*')
STEP = re.compile(r'\.([A-Za-z]\w*)|\[([^\[\]]+)\]')
WHOLE = re.compile(r'-?\d+')


class PathError(ValueError):
    """Raised, with the reason, if a path does not lead to a number."""


@dataclass(frozen=True)
class Field:
    """A path step to a field of a message."""

    name: str

    def __str__(self) -> str:
        """Return the step in path notation."""
        return f'.{self.name}'


@dataclass(frozen=True)
class Element:
    """A path step to an element of a list, by index or name."""

    key: int | str

    def __str__(self) -> str:
        """Return the step in path notation."""
        return f'[{self.key}]'


Step = Union[Field, Element]


@dataclass(frozen=True)
class FieldPath:
    """A topic and the path steps to a number in its messages."""

    topic: str
    steps: tuple[Step, ...]

    def __str__(self) -> str:
        """Return the path as text."""
        return self.topic + ''.join(map(str, self.steps))


def parse_path(text: str) -> FieldPath:
    """
    Parse the path of a number in the messages of a topic.

    Parameters
    ----------
    text
        For example `joint_states.position[left_knee]`; leading and trailing whitespace is ignored.

    Raises
    ------
    PathError
        The text has no topic, no field, or a syntax error; whether the field exists is not
        checked.

    """
    text = text.strip()
    topic = TOPIC.match(text)
    if topic is None:
        raise PathError(f"'{text}' does not begin with the name of a topic. {EXAMPLE}")
    steps: list[Step] = []
    at = topic.end()
    while at < len(text):
        found = STEP.match(text, at)
        if found is None:
            raise PathError(f"'{text}' goes wrong at '{text[at:]}': {_why(text[at:])} {EXAMPLE}")
        steps.append(_step(found))
        at = found.end()
    if not steps or isinstance(steps[0], Element):
        raise PathError(f"'{text}' names no field of the messages of a topic. {EXAMPLE}")
    return FieldPath(topic[0], tuple(steps))


def _step(found: re.Match[str]) -> Step:
    if found[1]:
        return Field(found[1])
    key = found[2].strip()
    return Element(int(key) if WHOLE.fullmatch(key) else key)


def _why(rest: str) -> str:
    """Explain a syntax error in a step."""
    if rest.startswith('['):
        return 'brackets hold a number or a name, and are closed.'
    if rest.startswith('/'):
        return 'in the name of a topic a letter or an underscore follows each slash.'
    if rest.startswith('.'):
        return 'after a dot comes the name of a field.'
    return 'a dot or a bracket is expected.'
