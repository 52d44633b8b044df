# SPDX-License-Identifier: Apache-2.0
"""How plotted series are written, such as `imu.angular_velocity.z`, and presets of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import isfinite
import re
from typing import Union

__all__ = [
    'MAX_PRESET_JOINTS',
    'MAX_SERIES',
    'Element',
    'Field',
    'FieldPath',
    'PathError',
    'Series',
    'Step',
    'effort',
    'imu',
    'parse_all',
    'parse_path',
    'parse_series',
    'tracking_error',
]

EXAMPLE = 'A path is like joint_states.position[left_knee] or imu.angular_velocity.z.'
TOPIC = re.compile(r'(~/|/)?[A-Za-z_][A-Za-z0-9_]*(/[A-Za-z_][A-Za-z0-9_]*)*')
STEP = re.compile(r'\.([A-Za-z]\w*)|\[([^\[\]]+)\]')
WHOLE = re.compile(r'-?\d+')

MAX_SERIES = 8
MINUS = ' - '

MAX_PRESET_JOINTS = 6


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
        raise PathError(f"'{text}' does not start with a topic name. {EXAMPLE}")
    steps: list[Step] = []
    at = topic.end()
    while at < len(text):
        found = STEP.match(text, at)
        if found is None:
            raise PathError(f"'{text}' is not valid at '{text[at:]}': {_why(text[at:])} {EXAMPLE}")
        steps.append(_step(found))
        at = found.end()
    if not steps or isinstance(steps[0], Element):
        raise PathError(f"'{text}' names no message field. {EXAMPLE}")
    return FieldPath(topic[0], tuple(steps))


def _step(found: re.Match[str]) -> Step:
    if found[1]:
        return Field(found[1])
    key = found[2].strip()
    return Element(int(key) if WHOLE.fullmatch(key) else key)


def _why(rest: str) -> str:
    """Explain a syntax error in a step."""
    if rest.startswith('['):
        return 'brackets must hold a number or a name, and be closed.'
    if rest.startswith('/'):
        return 'in a topic name, a letter or an underscore must follow each slash.'
    if rest.startswith('.'):
        return 'a field name must follow a dot.'
    return 'a dot or a bracket is expected.'


@dataclass(frozen=True)
class Series:
    """A numeric message field, or the first of two minus the second."""

    paths: tuple[FieldPath, ...]

    def __str__(self) -> str:
        """Return the series as text."""
        return MINUS.join(map(str, self.paths))

    def value(self, newest: list[float]) -> float:
        """
        Compute the value of the series from the numbers at its paths.

        Parameters
        ----------
        newest
            The latest number of each path, in order.

        """
        return newest[0] if len(newest) == 1 else newest[0] - newest[1]


def parse_series(text: str) -> Series:
    """
    Parse a series: a path, or the difference of two paths.

    Parameters
    ----------
    text
        `PATH` or `PATH - PATH`, with a space on each side of the minus.

    Raises
    ------
    PathError
        The text is neither.

    """
    parts = text.split(MINUS)
    if len(parts) > 2:
        raise PathError(f"'{text}' has more than one minus; a series is a path, or PATH - PATH.")
    return Series(tuple(map(parse_path, parts)))


def parse_all(text: str) -> list[Series]:
    """
    Parse a list of series; duplicates count once.

    Parameters
    ----------
    text
        Series separated by semicolons; may be empty.

    Raises
    ------
    PathError
        A part is not a valid series, or there are more than 8.

    """
    series = list(dict.fromkeys(parse_series(part) for part in text.split(';') if part.strip()))
    if len(series) > MAX_SERIES:
        raise PathError(f'{len(series)} series are too many for a plot: {MAX_SERIES} at most.')
    return series


def tracking_error(
    commands_topic: str,
    states_topic: str,
    commanded: Mapping[str, float],
    measured: Mapping[str, float],
) -> list[str]:
    """
    List series of the position error of the joints with the largest tracking errors.

    Parameters
    ----------
    commands_topic, states_topic
        The topics of commanded and of measured joint states.
    commanded, measured
        Positions by joint name, in rad or m; joints that are missing from either are ignored.

    Returns
    -------
    list of str
        At most 6 series, in the order of `commanded`.

    """
    errors = {name: commanded[name] - measured[name] for name in commanded if name in measured}
    return [
        f'{commands_topic}.position[{name}] - {states_topic}.position[{name}]'
        for name in _largest(errors)
    ]


def effort(states_topic: str, efforts: Mapping[str, float]) -> list[str]:
    """
    List series of the joints with the largest efforts.

    Parameters
    ----------
    states_topic
        The topic of joint states.
    efforts
        Efforts by joint name, in N m or N.

    Returns
    -------
    list of str
        At most 6 series, in the order of `efforts`.

    """
    return [f'{states_topic}.effort[{name}]' for name in _largest(efforts)]


def imu(topic: str) -> list[str]:
    """
    List the series of an IMU: its angular velocity and linear acceleration.

    Parameters
    ----------
    topic
        A topic of `sensor_msgs/msg/Imu`.

    """
    return [
        f'{topic}.{field}.{axis}'
        for field in ('angular_velocity', 'linear_acceleration')
        for axis in 'xyz'
    ]


def _largest(values: Mapping[str, float]) -> Sequence[str]:
    """Return the names with the largest absolute values, in the order of the mapping."""
    finite = {name: abs(value) for name, value in values.items() if isfinite(value)}
    by_size = sorted(finite, key=lambda name: finite[name], reverse=True)
    largest = set(by_size[:MAX_PRESET_JOINTS])
    return [name for name in finite if name in largest]
