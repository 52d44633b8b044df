# SPDX-License-Identifier: Apache-2.0
"""Velocity polygons: zones with one polygon for each range of velocities."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
import math

from nav2_collision_monitor.shapes import Polygon
from nav2_util.twist import Velocity

__all__ = ['VelocityPolygon', 'choose']


@dataclass(frozen=True)
class VelocityPolygon:
    """
    Polygon and its range of velocities: m/s, rad/s, rad; limits are inclusive.

    For robots that move sideways, `linear` is the speed and `direction` its direction in the base
    frame, from the start angle counter-clockwise to the end angle; else `linear` is that along x.
    """

    name: str
    shape: Polygon
    linear_min: float
    linear_max: float
    theta_min: float
    theta_max: float
    direction_start_angle: float = -math.pi
    direction_end_angle: float = math.pi

    def covers(self, velocity: Velocity, is_holonomic: bool) -> bool:
        """
        Whether a velocity is in the range of this polygon.

        Parameters
        ----------
        velocity
            The velocity in the base frame.
        is_holonomic
            Whether the robot moves sideways, so that speed and direction are compared instead of
            x.

        """
        linear = velocity.linear if is_holonomic else velocity.x
        if not self.linear_min <= linear <= self.linear_max:
            return False
        if not self.theta_min <= velocity.yaw <= self.theta_max:
            return False
        return not is_holonomic or self._has_direction(math.atan2(velocity.y, velocity.x))

    def _has_direction(self, angle: float) -> bool:
        start, end = self.direction_start_angle, self.direction_end_angle
        if start <= end:
            return start <= angle <= end
        return angle >= start or angle <= end


def choose(
    polygons: Sequence[VelocityPolygon], velocity: Velocity, is_holonomic: bool
) -> VelocityPolygon | None:
    """
    Choose the first polygon that covers a velocity.

    Parameters
    ----------
    polygons
        The polygons of a zone, in order.
    velocity, is_holonomic
        As for `VelocityPolygon.covers`.

    Returns
    -------
    VelocityPolygon or None
        None if no polygon covers it.

    """
    return next((each for each in polygons if each.covers(velocity, is_holonomic)), None)
