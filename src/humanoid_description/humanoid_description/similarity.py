# SPDX-License-Identifier: Apache-2.0
"""
Parameters of motions that scale with the size of a robot, so that its motion stays similar.

Gravity is the same for robots of all sizes: a robot of scale s moves as that of scale 1 does, in
times that are multiplied by sqrt(s) (Froude's law). The powers of s of all other quantities
follow; `config/scaling.yaml` derives those of the model.
"""

from __future__ import annotations

from dataclasses import fields, is_dataclass, replace
from functools import partial
from typing import Any, TypeVar

from humanoid_common.parameters import parameter

__all__ = [
    'angular_acceleration',
    'angular_damping',
    'duration',
    'fixed',
    'grown',
    'impulse',
    'length',
    'moment',
    'rate',
    'scaling',
    'share',
    'speed',
]

_POWER = 'humanoid_description.power'
"""Metadata key of the power of the robot's size with which a field scales."""
_MOST_CHANGE = 4.0
"""Factor by which a parameter may be above or below its default."""
T = TypeVar('T')


def scaling(power: float, value: float, description: str) -> float:
    """
    Declare a read-only parameter that scales with a power of the robot's size.

    Parameters
    ----------
    power
        The power of the scale.
    value, description
        The default at scale 1, and the description, as for `parameter`.

    """
    return parameter(
        value,
        description,
        at_least=value / _MOST_CHANGE,
        at_most=value * _MOST_CHANGE,
        read_only=True,
        metadata={_POWER: power},
    )


fixed = partial(scaling, 0.0)
"""Declare a parameter that is the same for all sizes: an angle, a ratio, an acceleration."""
length = partial(scaling, 1.0)
duration = partial(scaling, 0.5)
speed = partial(scaling, 0.5)
rate = partial(scaling, -0.5)
"""Declare an angular velocity, or a bandwidth in 1/s."""
angular_acceleration = partial(scaling, -1.0)
impulse = partial(scaling, 3.5)
moment = partial(scaling, 4.0)
"""Declare a torque, or a stiffness in N m/rad."""
angular_damping = partial(scaling, 4.5)


def share(value: float, description: str) -> float:
    """
    Declare a read-only fraction from 0.01 to 1, the same for all sizes.

    Parameters
    ----------
    value, description
        The default and the description, as for `parameter`.

    """
    return parameter(value, description, at_least=0.01, at_most=1.0, read_only=True)


def grown(values: T, scale: float) -> T:
    """
    Scale the fields of a parameter dataclass by their powers of the size, also those of groups.

    Parameters
    ----------
    values
        The parameters at scale 1; they are not modified.
    scale
        The size of the robot, positive.

    """
    scaled: T = _grown(values, scale)
    return scaled


def _grown(values: Any, scale: float) -> Any:
    changed = {}
    for entry in fields(values):
        value = getattr(values, entry.name)
        if is_dataclass(value):
            changed[entry.name] = _grown(value, scale)
        elif _POWER in entry.metadata:
            changed[entry.name] = value * scale ** entry.metadata[_POWER]
    return replace(values, **changed)
