# SPDX-License-Identifier: Apache-2.0
"""Walk straight to a place: turn towards it, walk, and turn to the final heading."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
import math

from robot_console.panels.drive import SpeedLimits, STILL, Velocity

__all__ = ['Outcome', 'Place', 'StraightWalk', 'Target']

NEAR_M, NEAR_RAD = 0.1, 0.1
"""The tolerances of the place and of the heading."""
AHEAD_RAD, ASTRAY_RAD = 0.15, 0.8
"""The robot walks once the place is this much ahead, and turns again if it is no longer."""
PASSED_M = 0.3
"""A place that comes to lie beside or behind the robot within this distance is reached, too."""
GAIN_1_S = 0.8
SLOWEST_M_S, SLOWEST_RAD_S = 0.05, 0.15
STUCK_S, PROGRESS_M = 6.0, 0.05
LEVER_M = 0.5
"""As progress, a turn by 1 rad counts as much as this distance."""
PATIENCE, LEAST_S = 3.0, 10.0
"""The walk may take so many times as long as at full speed, and some time in addition."""


@dataclass(frozen=True)
class Place:
    """The pose of the base of a robot on the ground, in the frame of its odometry."""

    x_m: float
    y_m: float
    yaw_rad: float


@dataclass(frozen=True)
class Target:
    """Where a robot is to walk, in the frame of its odometry; without a heading: any heading."""

    x_m: float
    y_m: float
    yaw_rad: float | None = None


class Outcome(Enum):
    """How a walk has ended."""

    ARRIVED = 'arrived'
    STUCK = 'stuck'
    TIMED_OUT = 'timed out'


class _Phase(Enum):
    TURN = 'turn towards the place'
    WALK = 'walk'
    FACE = 'turn to the final heading'


class StraightWalk:
    """
    Controller from the pose error to the velocity of the base, in axes of REP 103.

    Parameters
    ----------
    target
        Where to walk.
    limits
        The speed limits; sideways steps are not used.
    start, now_s
        Where the robot is, and its time.

    Attributes
    ----------
    outcome
        How the walk has ended; None while it goes on.
    distance_m
        How far the place is.

    """

    def __init__(self, target: Target, limits: SpeedLimits, start: Place, now_s: float) -> None:
        self.outcome: Outcome | None = None
        self._target, self._limits = target, limits
        self._phase = _Phase.TURN
        ahead_m, left_m = _seen_from(start, target)
        self.distance_m = math.hypot(ahead_m, left_m)
        walk_s = self.distance_m / max(limits.forward_m_s, SLOWEST_M_S)
        turn_s = math.tau / max(limits.turn_rad_s, SLOWEST_RAD_S)
        self._begin_s = now_s
        self._limit_s = LEAST_S + PATIENCE * (walk_s + turn_s)
        self._least_m, self._progress_s = math.inf, now_s

    @property
    def is_ahead(self) -> bool:
        """Whether the robot walks ahead, and does not turn in place."""
        return self._phase is _Phase.WALK

    def update(self, place: Place, now_s: float) -> Velocity:
        """
        Compute the velocity command. Call once per period.

        Parameters
        ----------
        place
            Where the robot is.
        now_s
            The robot's time; the walk does not take longer while a simulation is paused.

        Returns
        -------
        Velocity
            In the axes of the robot; zero once the walk has ended.

        """
        ahead_m, left_m = _seen_from(place, self._target)
        self.distance_m = math.hypot(ahead_m, left_m)
        bearing_rad = math.atan2(left_m, ahead_m)
        self._advance(ahead_m, bearing_rad)
        turn_rad = bearing_rad
        if self._phase is _Phase.FACE:
            yaw_rad = self._target.yaw_rad
            turn_rad = (
                0.0 if yaw_rad is None else math.remainder(yaw_rad - place.yaw_rad, math.tau)
            )
            if abs(turn_rad) < NEAR_RAD:
                self.outcome = Outcome.ARRIVED
        self._watch(turn_rad, now_s)
        if self.outcome is not None:
            return STILL
        limits = self._limits
        turn_rad_s = _towards(turn_rad, limits.turn_rad_s, SLOWEST_RAD_S)
        if self._phase is not _Phase.WALK:
            return Velocity(turn_rad_s=turn_rad_s)
        forward_m_s = _towards(self.distance_m, limits.forward_m_s, SLOWEST_M_S)
        # Less speed ahead while it still turns, so that the path is straight.
        share = max(0.0, math.cos(bearing_rad)) ** 2
        turn_rad_s = max(-limits.turn_rad_s, min(limits.turn_rad_s, GAIN_1_S * bearing_rad))
        return Velocity(forward_m_s * share, 0.0, turn_rad_s)

    def _advance(self, ahead_m: float, bearing_rad: float) -> None:
        """Go on to the next phase when one is done."""
        if self._phase is _Phase.FACE:
            return
        has_passed = self._phase is _Phase.WALK and self.distance_m < PASSED_M and ahead_m <= 0.0
        if self.distance_m < NEAR_M or has_passed:
            self._enter(_Phase.FACE)
        elif self._phase is _Phase.TURN and abs(bearing_rad) < AHEAD_RAD:
            self._enter(_Phase.WALK)
        elif self._phase is _Phase.WALK and abs(bearing_rad) > ASTRAY_RAD:
            self._enter(_Phase.TURN)

    def _enter(self, phase: _Phase) -> None:
        """Begin a phase; its progress is measured anew."""
        self._phase, self._least_m = phase, math.inf

    def _watch(self, turn_rad: float, now_s: float) -> None:
        """End a walk that gets no nearer, or takes too long."""
        if self.outcome is not None:
            return
        left_m = LEVER_M * abs(turn_rad)
        if self._phase is _Phase.WALK:
            left_m = self.distance_m
        if left_m < self._least_m - PROGRESS_M:
            self._least_m, self._progress_s = left_m, now_s
        elif now_s - self._progress_s > STUCK_S:
            self.outcome = Outcome.STUCK
        if not 0.0 <= now_s - self._begin_s <= self._limit_s:  # negative after a reset
            self.outcome = Outcome.TIMED_OUT


def _seen_from(place: Place, target: Target) -> tuple[float, float]:
    """Return a target in the axes of a robot: ahead, and to the left."""
    x_m, y_m = target.x_m - place.x_m, target.y_m - place.y_m
    cosine, sine = math.cos(place.yaw_rad), math.sin(place.yaw_rad)
    return cosine * x_m + sine * y_m, cosine * y_m - sine * x_m


def _towards(error: float, fastest: float, slowest: float) -> float:
    """Return the velocity that reduces an error, slower at its end, but never creeping."""
    speed = min(fastest, max(slowest, GAIN_1_S * abs(error)))
    return math.copysign(speed, error)
