# SPDX-License-Identifier: Apache-2.0
"""The way of the foot through the air."""

from __future__ import annotations

from dataclasses import dataclass
import math

from humanoid_control.dynamics.rotations import wrap_angle
from humanoid_control.walking.planar import PlanarPose, Point


@dataclass
class SwingFoot:
    """
    A foot on its way to a landing that may move.

    From where it is and how it moves it follows the cubic that is at rest above the landing at
    the time of arrival, planned anew at every tick.
    """

    pose: PlanarPose
    velocity_m_s: Point = 0j
    turn_rad_s: float = 0.0

    def advance(self, landing: PlanarPose, remaining_s: float, passed_s: float) -> PlanarPose:
        """Let time pass; `remaining_s` is the time from its begin to the arrival."""
        if remaining_s <= passed_s:
            self.pose, self.velocity_m_s, self.turn_rad_s = landing, 0j, 0.0
            return landing
        way_m = landing.position_m - self.pose.position_m
        way_rad = wrap_angle(landing.yaw_rad - self.pose.yaw_rad)
        moved_m, self.velocity_m_s = _cubic(way_m, self.velocity_m_s, remaining_s, passed_s)
        turned, turn_rad_s = _cubic(way_rad, self.turn_rad_s, remaining_s, passed_s)
        self.turn_rad_s = turn_rad_s.real
        self.pose = PlanarPose(self.pose.position_m + moved_m, self.pose.yaw_rad + turned.real)
        return self.pose


def lift_m(height_m: float, phase: float) -> float:
    """Return how high the foot is at a phase from 0 to 1; it leaves and lands gently."""
    return height_m * math.sin(math.pi * phase) ** 2 if 0.0 < phase < 1.0 else 0.0


def _cubic(way: Point, velocity: Point, duration: float, time: float) -> tuple[Point, Point]:
    """Return way and velocity at a time of the cubic that ends at rest after a way."""
    acceleration = (6.0 * way / duration - 4.0 * velocity) / duration
    jerk = (6.0 * velocity - 12.0 * way / duration) / duration**2
    return (
        velocity * time + acceleration * time**2 / 2 + jerk * time**3 / 6,
        velocity + acceleration * time + jerk * time**2 / 2,
    )
