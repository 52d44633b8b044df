# SPDX-License-Identifier: Apache-2.0
"""The way of the foot through the air."""

from __future__ import annotations

from dataclasses import dataclass
import math

from humanoid_control.dynamics.rotations import wrap_angle
from humanoid_control.walking.planar import PlanarPose, Point
from humanoid_control.walking.terrain import GroundPlane, LEVEL
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class SoleMotion:
    """Where a sole is to be, and how it is to move."""

    pose: PlanarPose
    plane: GroundPlane = LEVEL
    velocity_m_s: Point = 0j
    climb_m_s: float = 0.0
    turn_rad_s: float = 0.0
    acceleration_m_s2: Point = 0j
    climb_m_s2: float = 0.0
    turn_rad_s2: float = 0.0

    @property
    def acceleration(self) -> Array:
        """Return how it accelerates, (6,): linear in m/s2, then angular in rad/s2."""
        along = self.acceleration_m_s2
        return np.array([along.real, along.imag, self.climb_m_s2, 0.0, 0.0, self.turn_rad_s2])


@dataclass(frozen=True)
class Swing:
    """The sole that is in the air."""

    side: int
    sole: SoleMotion


@dataclass
class SwingFoot:
    """
    A foot on its way to a landing that may move.

    From where it is and how it moves it follows the polynomial of fifth order that is at rest
    above the landing at the time of arrival, planned anew at every tick.
    """

    pose: PlanarPose
    velocity_m_s: Point = 0j
    turn_rad_s: float = 0.0
    acceleration_m_s2: Point = 0j
    turn_rad_s2: float = 0.0

    def advance(self, landing: PlanarPose, remaining_s: float, passed_s: float) -> None:
        """
        Advance the swing foot by one control period on its way to the landing.

        Parameters
        ----------
        landing
            Where the foot is to land, in the odom frame; it may change from call to call.
        remaining_s
            The time from the start of the control period to the arrival above the landing.
        passed_s
            The length of the control period.

        """
        if remaining_s <= passed_s:
            self.pose = landing
            self.velocity_m_s = self.acceleration_m_s2 = 0j
            self.turn_rad_s = self.turn_rad_s2 = 0.0
            return
        way_m = landing.position_m - self.pose.position_m
        way_rad = wrap_angle(landing.yaw_rad - self.pose.yaw_rad)
        moved_m, self.velocity_m_s, self.acceleration_m_s2 = _quintic(
            (way_m, self.velocity_m_s, self.acceleration_m_s2), remaining_s, passed_s
        )
        turned, turn_rad_s, turn_rad_s2 = _quintic(
            (way_rad, self.turn_rad_s, self.turn_rad_s2), remaining_s, passed_s
        )
        self.turn_rad_s, self.turn_rad_s2 = turn_rad_s.real, turn_rad_s2.real
        self.pose = PlanarPose(self.pose.position_m + moved_m, self.pose.yaw_rad + turned.real)


@dataclass(frozen=True)
class Lift:
    """How a foot goes up and down: it leaves and lands gently, and reaches for late ground."""

    height_m: float
    duration_s: float
    reach_m_s: float
    deepest_m: float = math.inf
    """How far below where the ground was expected the foot reaches."""

    def at(self, time_s: float, rise_m: float = 0.0) -> tuple[float, float, float]:
        """
        Compute the height of the swing foot, its rate and its acceleration.

        Parameters
        ----------
        time_s
            The time since lift-off.
        rise_m
            How much higher the landing is expected than the lift-off.

        Returns
        -------
        tuple of float
            Height above the lift-off in m, rate in m/s, acceleration in m/s2; up is positive.

        """
        late_s = time_s - self.duration_s
        if late_s > 0.0:
            reaches = self.reach_m_s * late_s < self.deepest_m
            down_m = min(self.reach_m_s * late_s, self.deepest_m)
            return rise_m - down_m, -self.reach_m_s if reaches else 0.0, 0.0
        share = max(0.0, time_s) / self.duration_s
        phase, rate_1_s = math.pi * share, math.pi / self.duration_s
        top_m = self.height_m + abs(rise_m) / 2
        speed_m_s = top_m * rate_1_s
        return (
            top_m * math.sin(phase) ** 2 + rise_m * share**2 * (3 - 2 * share),
            speed_m_s * math.sin(2 * phase) + rise_m * 6 * share * (1 - share) / self.duration_s,
            2 * speed_m_s * rate_1_s * math.cos(2 * phase)
            + rise_m * (6 - 12 * share) / self.duration_s**2,
        )


def _quintic(
    start: tuple[Point, Point, Point], duration: float, time: float
) -> tuple[Point, Point, Point]:
    """Return way, velocity and acceleration of the polynomial that ends at rest after a way."""
    way, velocity, acceleration = start
    # In units of the duration.
    v, a, u = velocity * duration, acceleration * duration**2, time / duration
    c3 = 10.0 * way - 6.0 * v - 1.5 * a
    c4 = -15.0 * way + 8.0 * v + 1.5 * a
    c5 = 6.0 * way - 3.0 * v - 0.5 * a
    return (
        u * (v + u * (a / 2.0 + u * (c3 + u * (c4 + u * c5)))),
        (v + u * (a + u * (3.0 * c3 + u * (4.0 * c4 + u * 5.0 * c5)))) / duration,
        (a + u * (6.0 * c3 + u * (12.0 * c4 + u * 20.0 * c5))) / duration**2,
    )
