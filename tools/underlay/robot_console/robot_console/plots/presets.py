# SPDX-License-Identifier: Apache-2.0
"""Series that are often plotted together."""

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
    largest = set(sorted(finite, key=lambda name: finite[name], reverse=True)[:MOST])
    return [name for name in finite if name in largest]
