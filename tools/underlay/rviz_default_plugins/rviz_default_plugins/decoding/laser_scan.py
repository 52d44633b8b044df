# SPDX-License-Identifier: Apache-2.0
"""The points of `sensor_msgs/msg/LaserScan`."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from rviz_default_plugins.decoding.cloud import Cloud

__all__ = ['decode_scan']


def decode_scan(message: Any) -> Cloud:
    """
    Convert `sensor_msgs/msg/LaserScan` to points.

    Parameters
    ----------
    message
        The message.

    Returns
    -------
    Cloud
        The ranges from `range_min` to `range_max`, as points in the frame of the scanner, in m;
        with a channel `intensity` if there is one for each range.

    Raises
    ------
    ValueError
        The first angle or the angle increment is not finite.

    """
    if not (math.isfinite(message.angle_min) and math.isfinite(message.angle_increment)):
        raise ValueError('its angles are not finite.')
    ranges = np.asarray(message.ranges, dtype=np.float64)
    angles = message.angle_min + np.arange(len(ranges)) * message.angle_increment
    hit = np.isfinite(ranges) & (ranges >= message.range_min) & (ranges <= message.range_max)
    reach, angles = ranges[hit], angles[hit]
    points = np.stack(
        [reach * np.cos(angles), reach * np.sin(angles), np.zeros_like(reach)], axis=1
    )
    return Cloud(points.astype(np.float32), _intensities(message, len(ranges), hit))


def _intensities(message: Any, count: int, hit: Any) -> dict[str, Any]:
    """Return the channel of intensities, if there is one for each range."""
    intensities = np.asarray(message.intensities, dtype=np.float32)
    return {'intensity': intensities[hit]} if count and len(intensities) == count else {}
