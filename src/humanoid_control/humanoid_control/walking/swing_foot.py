# SPDX-License-Identifier: Apache-2.0
"""The way of the foot through the air."""

from __future__ import annotations

from dataclasses import dataclass
import math

from humanoid_control.dynamics.rotations import wrap_angle
from humanoid_control.walking.planar import PlanarPose, Point


@dataclass(frozen=True)
class SoleMotion:
    """Where a sole is to be, level, and how it is to move."""

    pose: PlanarPose
    height_m: float = 0.0
    velocity_m_s: Point = 0j
    climb_m_s: float = 0.0
    turn_rad_s: float = 0.0


@dataclass(frozen=True)
class Swing:
    """The sole that is in the air."""

    side: int
    sole: SoleMotion


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

    def advance(self, landing: PlanarPose, remaining_s: float, passed_s: float) -> None:
        """Let time pass; `remaining_s` is the time from its begin to the arrival."""
        if remaining_s <= passed_s:
            self.pose, self.velocity_m_s, self.turn_rad_s = landing, 0j, 0.0
            return
        way_m = landing.position_m - self.pose.position_m
        way_rad = wrap_angle(landing.yaw_rad - self.pose.yaw_rad)
        moved_m, self.velocity_m_s = _cubic(way_m, self.velocity_m_s, remaining_s, passed_s)
        turned, turn_rad_s = _cubic(way_rad, self.turn_rad_s, remaining_s, passed_s)
        self.turn_rad_s = turn_rad_s.real
        self.pose = PlanarPose(self.pose.position_m + moved_m, self.pose.yaw_rad + turned.real)


@dataclass(frozen=True)
class Lift:
    """How a foot goes up and down: it leaves and lands gently, and reaches for late ground."""

    height_m: float
    duration_s: float
    reach_m_s: float

    def at(self, time_s: float) -> tuple[float, float]:
        """Return height and rate of climb at a time since lift-off."""
        if time_s > self.duration_s:
            return -self.reach_m_s * (time_s - self.duration_s), -self.reach_m_s
        rate_1_s = math.pi / self.duration_s
        phase = rate_1_s * max(0.0, time_s)
        return self.height_m * math.sin(phase) ** 2, self.height_m * rate_1_s * math.sin(2 * phase)


def _cubic(way: Point, velocity: Point, duration: float, time: float) -> tuple[Point, Point]:
    """Return way and velocity at a time of the cubic that ends at rest after a way."""
    acceleration = (6.0 * way / duration - 4.0 * velocity) / duration
    jerk = (6.0 * velocity - 12.0 * way / duration) / duration**2
    return (
        velocity * time + acceleration * time**2 / 2 + jerk * time**3 / 6,
        velocity + acceleration * time + jerk * time**2 / 2,
    )
