# SPDX-License-Identifier: Apache-2.0
"""Ports of nodes: their types, defaults, and the conversion of XML attributes to values."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
import math
import re
from typing import Any, NamedTuple

from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Path

__all__ = ['REQUIRED', 'Binding', 'Port', 'bind', 'in_port', 'out_port']

_KEY = re.compile(r'\{\s*([@\w./=-]+)\s*\}')
_POSE_PARTS = 9


class _Required:
    """The default of a mandatory port."""


REQUIRED = _Required()


@dataclass(frozen=True)
class Port:
    """
    Port of a node: an attribute in an XML file.

    Parameters
    ----------
    kind
        The type of its value, one of those in `CONVERTERS`.
    default
        Its value if it is not set: a text as in the file (`{goal}`, `1.0`), None, or REQUIRED.
    description
        Its purpose.
    is_output
        Whether the node writes it.

    """

    kind: str
    default: Any
    description: str
    is_output: bool = False


def in_port(kind: str, default: Any, description: str) -> Port:
    """
    Make an input port.

    Parameters
    ----------
    kind, default, description
        As for `Port`.

    """
    return Port(kind, default, description)


def out_port(kind: str, description: str, default: Any = None) -> Port:
    """
    Make an output port.

    Parameters
    ----------
    kind, description, default
        As for `Port`.

    """
    return Port(kind, default, description, is_output=True)


class Binding(NamedTuple):
    """Binding of a port: to a blackboard key, or to a value."""

    key: str | None
    value: Any
    kind: str


def bind(name: str, port: Port, text: str | None) -> Binding:
    """
    Parse the text of a port, or its default if there is none.

    Parameters
    ----------
    name
        The name of the port, which `{=}` stands for.
    port
        The port.
    text
        The attribute in the XML file; None if it is missing.

    Returns
    -------
    Binding
        A key of the blackboard for `{key}`, else the converted value; neither for an output that
        is not bound.

    Raises
    ------
    ValueError
        It is not a valid value of that port; the text ends a sentence that starts with the port.

    """
    source = port.default if text is None else text
    if source is REQUIRED:
        raise ValueError('is missing')
    if not isinstance(source, str):
        return Binding(None, source, port.kind)
    match = _KEY.fullmatch(source.strip())
    if match:
        return Binding(name if match[1] == '=' else match[1], None, port.kind)
    if port.is_output:
        if source and text is not None:
            raise ValueError(f"must be a key of the blackboard such as '{{{name}}}', not a value")
        return Binding(None, None, port.kind)
    return Binding(None, convert(source, port.kind), port.kind)


def convert(text: str, kind: str) -> Any:
    """
    Convert a text to the type of a port.

    Parameters
    ----------
    text
        As in an XML file or on the blackboard.
    kind
        The type of the value, one of those in `CONVERTERS`.

    Raises
    ------
    ValueError
        It cannot be converted; the text is the end of a sentence about it.

    """
    try:
        return CONVERTERS[kind](text)
    except ValueError as error:
        raise ValueError(f"must be {_NAMES.get(kind, kind)}, but is '{text}'") from error


def _boolean(text: str) -> bool:
    values = {'true': True, '1': True, 'false': False, '0': False}
    if text.strip().lower() not in values:
        raise ValueError(text)
    return values[text.strip().lower()]


def _whole(text: str) -> int:
    return int(text.strip(), 0) if text.strip().lower().startswith('0x') else int(text)


def _natural(text: str) -> int:
    value = _whole(text)
    if value < 0:
        raise ValueError(text)
    return value


def _number(text: str) -> float:
    value = float(text)
    if math.isnan(value):
        raise ValueError(text)
    return value


def _codes(text: str) -> frozenset[int]:
    return frozenset(_whole(each) for each in re.split('[;,]', text) if each.strip())


def _pose(parts: list[str]) -> PoseStamped:
    """Parse stamp;frame;x;y;z;qx;qy;qz;qw, the format of poses in Nav2."""
    if len(parts) != _POSE_PARTS:
        raise ValueError(parts)
    pose = PoseStamped()
    stamp = int(parts[0])
    pose.header.stamp.sec, pose.header.stamp.nanosec = divmod(stamp, 1_000_000_000)
    pose.header.frame_id = parts[1].strip()
    at, turned = pose.pose.position, pose.pose.orientation
    at.x, at.y, at.z = map(float, parts[2:5])
    turned.x, turned.y, turned.z, turned.w = map(float, parts[5:])
    return pose


def _poses(text: str) -> list[PoseStamped]:
    parts = text.split(';') if text.strip() else []
    starts = range(0, len(parts), _POSE_PARTS)
    return [_pose(parts[slice(at, at + _POSE_PARTS)]) for at in starts]


def _path(text: str) -> Path:
    stamp, frame, *parts = text.split(';')
    path = Path(poses=_poses(';'.join(parts)))
    path.header.stamp.sec, path.header.stamp.nanosec = divmod(int(stamp), 1_000_000_000)
    path.header.frame_id = frame.strip()
    return path


CONVERTERS: dict[str, Callable[[str], Any]] = {
    'text': str,
    'any': str,
    'number': _number,
    'whole': _whole,
    'natural': _natural,
    'milliseconds': _natural,
    'boolean': _boolean,
    'codes': _codes,
    'pose': lambda text: _pose(text.split(';')),
    'poses': _poses,
    'path': _path,
}
_NAMES = {
    'number': 'a number',
    'whole': 'a whole number',
    'natural': 'a whole number from 0 on',
    'milliseconds': 'a whole number of milliseconds',
    'boolean': "'true' or 'false'",
    'codes': 'a list of codes such as 100;103',
    'pose': "a key of the blackboard or 'stamp;frame;x;y;z;qx;qy;qz;qw'",
    'poses': "a key of the blackboard or poses 'stamp;frame;x;y;z;qx;qy;qz;qw', one after another",
    'path': 'a key of the blackboard',
}
