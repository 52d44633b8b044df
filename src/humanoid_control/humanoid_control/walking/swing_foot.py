# SPDX-License-Identifier: Apache-2.0
"""How a foot swings: the clock of its step, and its trajectory."""

from __future__ import annotations

from dataclasses import dataclass
import math

from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.planar import GroundPlane, LEVEL, PlanarPose, Point
from humanoid_description.rotations import wrap_angle
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class SoleMotion:
    """Target pose of a sole, with its velocity and acceleration."""

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
        """Return the acceleration: linear in m/s2, then angular in rad/s2 (6,)."""
        along = self.acceleration_m_s2
        return np.array([along.real, along.imag, self.climb_m_s2, 0.0, 0.0, self.turn_rad_s2])


@dataclass(frozen=True)
class Swing:
    """Target of the swing foot."""

    side: int
    sole: SoleMotion


class StepClock:
    """
    Clock of a step, which may run faster than real time to catch the robot.

    Parameters
    ----------
    parameters : WalkParameters
        Gait parameters.
    shift_s
        Duration of double support, in which the weight shifts to the support foot.

    Attributes
    ----------
    elapsed_s, rate
        Time on this clock, and its rate relative to real time.
    passed_s
        Real time for which the swing foot moves in this control period.

    """

    def __init__(self, parameters: WalkParameters, shift_s: float) -> None:
        self._parameters = parameters
        self.shift_s = shift_s
        self.passed_s = 0.0
        self._real_s = 0.0
        self.elapsed_s = 0.0
        self.rate = 1.0

    @property
    def end_s(self) -> float:
        """Return the planned time of the landing, on this clock."""
        return self.shift_s + self._parameters.timing.swing_s

    @property
    def adjustable_until_s(self) -> float:
        """Return the time from which the landing no longer changes, on this clock."""
        return self.end_s - self._parameters.step_adjustment.until_s

    @property
    def duration_s(self) -> float:
        """Return the actual duration, with the weight shift counted at its regular duration."""
        return self._real_s + self._parameters.timing.shift_s - self.shift_s

    @property
    def in_air_s(self) -> float:
        """Return the time since the planned lift-off, on this clock; negative before it."""
        return self.elapsed_s - self.shift_s

    @property
    def swing_phase(self) -> float:
        """Return the phase of the swing: 0 in double support, 1 at its end, above 1 if late."""
        return max(0.0, self.in_air_s) / self._parameters.timing.swing_s

    @property
    def arrival_s(self) -> float:
        """Return the real time until the foot is above its landing."""
        p = self._parameters
        return (p.swing.early_arrival * p.timing.swing_s - self.in_air_s) / self.rate

    @property
    def is_late(self) -> bool:
        """Whether the landing is overdue."""
        return self.elapsed_s > self.end_s + self._parameters.swing.late_touchdown_s

    def advance(self, passed_s: float, *, waits: bool) -> None:
        """
        Advance the clock by one control period.

        Parameters
        ----------
        passed_s
            Time since the last control period.
        waits
            Whether it waits for the swing foot after a gap in control.

        """
        before_s = self.elapsed_s
        self.passed_s = min(passed_s, self._parameters.swing.longest_tick_s)
        self._real_s += passed_s
        self.elapsed_s += passed_s * self.rate
        if waits:
            in_air_s = before_s + self.passed_s * self.rate
            self.elapsed_s = min(self.elapsed_s, max(self.shift_s, in_air_s))


@dataclass
class SwingFoot:
    """
    Horizontal swing foot trajectory to a landing that may move.

    In every control period it is replanned from the present position, velocity and acceleration:
    a fifth-order polynomial that comes to rest above the landing at the time of arrival.
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
            Target pose of the landing, in the odom frame; it may change from call to call.
        remaining_s
            Time from the start of the control period to the arrival above the landing.
        passed_s
            Duration of the control period.

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
    """Vertical swing foot trajectory: gentle lift-off and landing, then down to late ground."""

    height_m: float
    duration_s: float
    reach_m_s: float
    deepest_m: float = math.inf
    """Greatest depth below the expected ground to which the foot reaches."""

    def at(self, time_s: float, rise_m: float = 0.0) -> tuple[float, float, float]:
        """
        Compute the height of the swing foot, its rate and its acceleration.

        Parameters
        ----------
        time_s
            Time since lift-off.
        rise_m
            Expected height of the landing above the lift-off.

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


class SwingTrajectory:
    """
    Trajectory of a swing foot, from its lift-off to a landing that may move, over sloping ground.

    Parameters
    ----------
    parameters : WalkParameters
        Gait parameters.
    lift_off
        Pose of the foot before, in the odom frame.
    tilt
        Tilt of its sole as long as it has not moved.

    Attributes
    ----------
    tilt
        Present tilt of its sole.

    """

    def __init__(self, parameters: WalkParameters, lift_off: PlanarPose, tilt: Point) -> None:
        p = parameters
        self._turn_back_m_s = p.obstacles.turn_back_m_s
        self._foot = SwingFoot(lift_off)
        self._lift = Lift(
            p.swing.height_m, p.timing.swing_s, p.swing.reach_down_m_s, p.swing.deepest_m
        )
        self.tilt = tilt

    def restart(self, pose: PlanarPose) -> None:
        """
        Go on at rest from where the foot is.

        Parameters
        ----------
        pose
            Measured pose of its sole, in the odom frame.

        """
        self._foot = SwingFoot(pose)

    def in_time(self, landing: PlanarPose, clock: StepClock) -> PlanarPose:
        """
        Limit a landing to what the foot can reach in time: a faster swing topples the robot.

        Parameters
        ----------
        landing
            Pose of the landing, in the odom frame.
        clock
            Clock of the step.

        """
        if clock.swing_phase <= 0.0:
            return landing
        start_m = self._foot.pose.position_m
        way_m = landing.position_m - start_m
        most_m = self._turn_back_m_s * max(0.0, clock.arrival_s)
        if abs(way_m) <= most_m:
            return landing
        return PlanarPose(start_m + way_m * (most_m / abs(way_m)), landing.yaw_rad)

    def advance(
        self,
        clock: StepClock,
        landing: PlanarPose,
        start: GroundPlane,
        rise_m: float,
        slope: Point,
    ) -> SoleMotion:
        """
        Compute the swing foot target. Call once per control period.

        Parameters
        ----------
        clock
            Clock of the step.
        landing
            Pose of the landing, in the odom frame.
        start
            Ground plane at the lift-off.
        rise_m, slope
            Expected height of the ground at the landing above that at the lift-off, and its tilt.

        """
        foot = self._foot
        passed_s = min(clock.passed_s, clock.in_air_s / clock.rate)
        foot.advance(landing, clock.arrival_s + passed_s, passed_s)
        height_m, climb_m_s, climb_m_s2 = self._lift.at(clock.in_air_s, rise_m)
        share = min(1.0, clock.swing_phase)
        self.tilt = start.tilt + share * (slope - start.tilt)
        return SoleMotion(
            foot.pose,
            GroundPlane(start.height_m + height_m, self.tilt),
            foot.velocity_m_s,
            climb_m_s * clock.rate,
            foot.turn_rad_s,
            foot.acceleration_m_s2,
            climb_m_s2 * clock.rate**2,
            foot.turn_rad_s2,
        )


def _quintic(
    start: tuple[Point, Point, Point], duration: float, time: float
) -> tuple[Point, Point, Point]:
    """Evaluate displacement, velocity and acceleration of a quintic that ends at rest."""
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
