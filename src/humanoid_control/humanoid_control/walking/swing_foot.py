# SPDX-License-Identifier: Apache-2.0
"""The way of the foot through the air."""

from __future__ import annotations

from dataclasses import dataclass
import math

from humanoid_control.dynamics.rotations import wrap_angle
from humanoid_control.walking.planar import PlanarPose, Point
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Planar:
    """A velocity or acceleration in the plane, and of the turn about the vertical."""

    linear: Point = 0j
    angular: float = 0.0


@dataclass(frozen=True)
class Lift:
    """How high something is, how fast it rises, and how that changes."""

    height_m: float = 0.0
    speed_m_s: float = 0.0
    acceleration_m_s2: float = 0.0


@dataclass(frozen=True)
class Swing:
    """A sole in the air at a moment."""

    side: int
    pose: PlanarPose
    lift: Lift
    velocity: Planar = Planar()
    acceleration: Planar = Planar()

    @property
    def velocity6(self) -> Array:
        """Return the velocity (6,): linear in m/s, then angular in rad/s."""
        return _spatial(self.velocity, self.lift.speed_m_s)

    @property
    def acceleration6(self) -> Array:
        """Return the acceleration (6,): linear in m/s2, then angular in rad/s2."""
        return _spatial(self.acceleration, self.lift.acceleration_m_s2)


@dataclass
class SwingFoot:
    """
    A foot on its way to a landing that may move.

    From where it is and how it moves it follows the polynomial of fifth order that is at rest
    above the landing at the time of arrival, planned anew at every tick.
    """

    pose: PlanarPose
    velocity: Planar = Planar()
    acceleration: Planar = Planar()

    def advance(self, landing: PlanarPose, remaining_s: float, passed_s: float) -> PlanarPose:
        """Let time pass; `remaining_s` is the time from its begin to the arrival."""
        if remaining_s <= passed_s:
            self.pose, self.velocity, self.acceleration = landing, Planar(), Planar()
            return landing
        way_m = landing.position_m - self.pose.position_m
        way_rad = wrap_angle(landing.yaw_rad - self.pose.yaw_rad)
        moved_m, speed_m_s, gain_m_s2 = _quintic(
            (way_m, self.velocity.linear, self.acceleration.linear), remaining_s, passed_s
        )
        turned, turning, turn_gain = _quintic(
            (way_rad, self.velocity.angular, self.acceleration.angular), remaining_s, passed_s
        )
        self.velocity = Planar(speed_m_s, turning.real)
        self.acceleration = Planar(gain_m_s2, turn_gain.real)
        self.pose = PlanarPose(self.pose.position_m + moved_m, self.pose.yaw_rad + turned.real)
        return self.pose


def lift_at(height_m: float, phase: float, phase_rate_1_s: float) -> Lift:
    """Return how high the foot is at a phase from 0 to 1; it leaves and lands gently."""
    if not 0.0 < phase < 1.0:
        return Lift()
    turn, turn_rate = math.pi * phase, math.pi * phase_rate_1_s
    return Lift(
        height_m * math.sin(turn) ** 2,
        height_m * turn_rate * math.sin(2.0 * turn),
        2.0 * height_m * turn_rate**2 * math.cos(2.0 * turn),
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


def _spatial(planar: Planar, upwards: float) -> Array:
    """Return linear and angular parts (6,)."""
    return np.array([planar.linear.real, planar.linear.imag, upwards, 0.0, 0.0, planar.angular])
