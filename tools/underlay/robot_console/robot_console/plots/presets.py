# SPDX-License-Identifier: Apache-2.0
"""Series that are often wanted together."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isfinite

__all__ = ['MOST', 'effort', 'imu', 'tracking_error']

MOST = 6


def tracking_error(
    commands_topic: str,
    states_topic: str,
    commanded: Mapping[str, float],
    measured: Mapping[str, float],
) -> list[str]:
    """Return series of those joints that are farthest from where they were told to be."""
    errors = {name: commanded[name] - measured[name] for name in commanded if name in measured}
    return [
        f'{commands_topic}.position[{name}] - {states_topic}.position[{name}]'
        for name in _largest(errors)
    ]


def effort(states_topic: str, efforts: Mapping[str, float]) -> list[str]:
    """Return series of those joints that have most to do."""
    return [f'{states_topic}.effort[{name}]' for name in _largest(efforts)]


def imu(topic: str) -> list[str]:
    """Return the series of an inertial measurement unit: how it turns and accelerates."""
    return [
        f'{topic}.{field}.{axis}'
        for field in ('angular_velocity', 'linear_acceleration')
        for axis in 'xyz'
    ]


def _largest(values: Mapping[str, float]) -> Sequence[str]:
    """Return some names with the largest values of either sign, in the order of the mapping."""
    finite = {name: abs(value) for name, value in values.items() if isfinite(value)}
    largest = set(sorted(finite, key=lambda name: finite[name], reverse=True)[:MOST])
    return [name for name in finite if name in largest]
