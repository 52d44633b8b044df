# SPDX-License-Identifier: Apache-2.0
"""Validation of the parameters of joint_state_publisher."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from math import isfinite
from typing import Any

from ros_environment.suggestions import did_you_mean
from urdf import check_for_loops, Mimic

__all__ = ['DESCRIPTIONS', 'MAPS', 'Settings', 'checked', 'settings_of']

DESCRIPTIONS = {
    'rate': 'The rate at which joint states are published, in Hz.',
    'source_list': 'Joint state topics whose values are merged.',
    'use_mimic_tags': 'Let joints follow others according to their <mimic> tags.',
    'use_smallest_joint_limits': 'Also keep within the limits of <safety_controller>.',
    'publish_default_positions': 'Publish a default position for joints that no source reports.',
    'publish_default_velocities': 'Publish velocity 0 for joints whose velocity is unknown.',
    'publish_default_efforts': 'Publish effort 0 for joints whose effort is unknown.',
    'delta': 'How far each joint moves by itself between two messages, in radians or metres.',
    'robot_description': 'The text of the URDF; it is taken from the topic if this is empty.',
}
MAPS = ('zeros.', 'dependent_joints.')
"""Prefixes of the parameters that belong to individual joints."""
RATES = (0.001, 1000.0)
DEPENDENT_KEYS = ('parent', 'factor', 'offset')


@dataclass(frozen=True)
class Settings:
    """Settings of the node; `zeros` and `dependent_joints` are by joint name."""

    rate: float = 10
    source_list: tuple[str, ...] = ()
    use_mimic_tags: bool = True
    use_smallest_joint_limits: bool = True
    publish_default_positions: bool = True
    publish_default_velocities: bool = False
    publish_default_efforts: bool = False
    delta: float = 0.0
    robot_description: str = ''
    zeros: Mapping[str, float] = field(default_factory=dict)
    dependent_joints: Mapping[str, Mimic] = field(default_factory=dict)


def settings_of(values: Mapping[str, Any]) -> Settings:
    """
    Validate parameters and convert them to settings.

    Parameters
    ----------
    values
        Parameter values by name; unknown names are ignored, and missing ones get defaults.

    Raises
    ------
    ValueError
        A value has the wrong type or is out of range, or `dependent_joints` is incomplete or
        contains a loop.

    """
    known = {each.name: each.default for each in fields(Settings)}
    plain = {
        name: checked(name, value, known[name])
        for name, value in values.items()
        if name in DESCRIPTIONS
    }
    settings = Settings(**plain, zeros=_zeros(values), dependent_joints=_dependents(values))
    low, high = RATES
    if not low <= settings.rate <= high:
        raise ValueError(
            f"The parameter 'rate' must be from {low:g} to {high:g}, not {settings.rate:g}."
        )
    return settings


def _zeros(values: Mapping[str, Any]) -> dict[str, float]:
    """Return the default positions given as `zeros.JOINT`."""
    return {
        name.removeprefix('zeros.'): checked(name, value, 0.0)
        for name, value in values.items()
        if name.startswith('zeros.')
    }


def _dependents(values: Mapping[str, Any]) -> dict[str, Mimic]:
    """Parse `dependent_joints.JOINT.parent`, `.factor` and `.offset` into mimic relations."""
    parts: dict[str, dict[str, Any]] = {}
    for name, value in values.items():
        if name.startswith('dependent_joints.'):
            joint, _, key = name.removeprefix('dependent_joints.').rpartition('.')
            if not joint or key not in DEPENDENT_KEYS:
                raise ValueError(
                    f"The parameter '{name}' must end with one of {', '.join(DEPENDENT_KEYS)}. "
                    f'{did_you_mean(key, DEPENDENT_KEYS, 0.75)}'.rstrip()
                )
            default = '' if key == 'parent' else 0.0
            parts.setdefault(joint, {})[key] = checked(name, value, default)
    dependents = {joint: _dependent(joint, part) for joint, part in parts.items()}
    try:
        check_for_loops(dependents)
    except ValueError as loop:
        raise ValueError(f'dependent_joints follow each other in a loop: {loop}.') from loop
    return dependents


def _dependent(joint: str, part: Mapping[str, Any]) -> Mimic:
    if not part.get('parent'):
        raise ValueError(
            f"The joint '{joint}' follows no joint: set dependent_joints.{joint}.parent."
        )
    return Mimic(part['parent'], part.get('factor', 1.0), part.get('offset', 0.0))


def checked(name: str, value: Any, default: Any) -> Any:
    """
    Convert the value of a parameter to the type of its default.

    Parameters
    ----------
    name
        The name of the parameter, for the error message.
    value
        The given value.
    default
        A value of the required type: a tuple of strings, a bool, a string or a number.

    Returns
    -------
    object
        The value; numbers as floats, lists as tuples.

    Raises
    ------
    ValueError
        The value has another type or is not finite.

    """
    if isinstance(default, tuple):
        # ROS has no type for an empty list; None is passed instead.
        texts = [] if value is None else value
        if not isinstance(texts, (list, tuple)) or not all(
            isinstance(text, str) for text in texts
        ):
            raise _wrong(name, value, 'a list of names')
        return tuple(texts)
    if isinstance(default, (bool, str)):
        if not isinstance(value, type(default)):
            raise _wrong(name, value, 'true or false' if default in (True, False) else 'a string')
        return value
    if not isinstance(value, (int, float)) or isinstance(value, bool) or not isfinite(value):
        raise _wrong(name, value, 'a number')
    return float(value)


def _wrong(name: str, value: Any, wanted: str) -> ValueError:
    return ValueError(f"The parameter '{name}' must be {wanted}, not {value!r}.")
