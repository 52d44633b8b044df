# SPDX-License-Identifier: Apache-2.0
"""Obstacle reaction: stop on contact, step back, and block velocities towards the obstacle."""

from __future__ import annotations

import cmath
from collections.abc import Sequence
from dataclasses import dataclass, replace
import math

from humanoid_control.walking.commands import STANDING, VelocityCommand
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.planar import cross, dot, PlanarPose, Point

_ALONG = 0.5
"""Fraction of a velocity that must lead along the obstacle for the robot to walk past it."""
_STILL_M_S = 1e-3


@dataclass(frozen=True)
class Touch:
    """
    Push on each limb, left and right: its direction, and the moment (N m) about hip or shoulder.

    The ground pushes a stance leg as well: the moment of a leg is valid only while it swings.
    """

    legs_nm: tuple[Point, Point] = (0j, 0j)
    arms_nm: tuple[Point, Point] = (0j, 0j)


NOTHING = Touch()


@dataclass(frozen=True)
class LegInAir:
    """Swing leg, and the push on it."""

    side: int
    push_nm: Point
    """Direction of the push, and its moment about the hip."""
    foot_m: Point
    """Position of the foot."""


@dataclass(frozen=True)
class ExternalForces:
    """External forces and moments on the robot, in the axes of the odom frame."""

    force_n: Point = 0j
    """Horizontal external force on the whole robot."""
    arms_nm: Sequence[Point] = ()
    """Directions of the pushes on the arms, and their moments about the shoulders."""
    leg: LegInAir | None = None


@dataclass
class Blockage:
    """Obstacle in the way of the robot, and the state of the retreat from it."""

    towards: Point
    """Direction to it, a unit vector in the plane of the odom frame."""
    place_m: Point
    """Where the robot met it: the middle between its feet, with the front one beside the rear."""
    leg: LegInAir | None = None
    """The leg that met it, if one did: no foot may land beyond that point."""
    elapsed_s: float = 0.0
    retreats: bool = True
    leans: bool = False
    """Whether the DCM is off towards it: steps away from it would increase that error."""
    let_go_s: float = 0.0
    """Time for which no velocity towards it has been commanded."""


@dataclass(frozen=True)
class _Travel:
    """Direction of travel of the robot."""

    ahead: Point
    """Unit vector in the plane of the odom frame; zero without a linear velocity."""
    aside: float
    """Magnitude of its lateral component in the axes of the robot."""
    moves: bool
    """Whether the robot moves or turns."""

    @classmethod
    def of(cls, going: VelocityCommand, heading_rad: float) -> _Travel:
        """Compute the direction of travel for a velocity and a heading."""
        speed = going.linear_m_s
        if abs(speed) < _STILL_M_S:
            return cls(0j, 0.0, abs(going.turn_rad_s) > _STILL_M_S)
        along = speed / abs(speed)
        return cls(along * cmath.rect(1.0, heading_rad), abs(along.imag), True)

    def against(self, push: Point) -> float:
        """Compute the component of a push against the direction of travel."""
        return -dot(push, self.ahead)

    def towards(self, push: Point) -> Point:
        """
        Estimate the direction to an obstacle from its push.

        Friction deflects the push, and the obstacle is where the robot goes: take the bisector.
        """
        both = self.ahead - push / abs(push)
        return both / abs(both)


class ObstacleGuard:
    """
    Obstacle detection by the force against the motion, and retreat from obstacles.

    The force is integrated with exponential forgetting: a short push stays below the threshold,
    an obstacle that stays in the way soon exceeds it. The robot then stops, steps back a little,
    and rejects velocities in that direction until none is commanded for a while, or until it is
    elsewhere.

    Parameters
    ----------
    parameters : WalkParameters
        Gait parameters, with the contact thresholds and the distance of the retreat.

    Attributes
    ----------
    blockage
        The obstacle in the way; None while the way is free, as at the start.

    """

    def __init__(self, parameters: WalkParameters) -> None:
        self._parameters = parameters
        self._impulse_ns: Point = 0j
        self.blockage: Blockage | None = None

    def update(
        self,
        contact: ExternalForces,
        stands: tuple[PlanarPose, PlanarPose],
        wanted: VelocityCommand,
        going: VelocityCommand,
        error_m: Point,
        passed_s: float,
    ) -> bool:
        """
        Detect whether the robot has met an obstacle since the last control period.

        A new obstacle becomes the `blockage`. From a known one the robot retreats; it is forgotten
        when the robot is elsewhere or when no velocity towards it has been commanded for a while.

        Parameters
        ----------
        contact
            External forces and moments on the robot, in the axes of the odom frame.
        stands
            Poses of the robot if it stood beside its left and its right foot, in the odom frame.
        wanted, going
            Commanded velocity, and that at which the robot moves, in its own axes.
        error_m
            Error of the divergent component of motion (DCM), in the axes of the odom frame.
        passed_s
            Time since the last control period.

        Returns
        -------
        bool
            Whether the robot has just met a new obstacle.

        """
        p, body = self._parameters, stands[0].halfway(stands[1])
        fading = math.exp(-passed_s / p.obstacles.bump_memory_s)
        self._impulse_ns = self._impulse_ns * fading + contact.force_n * passed_s
        if self.blockage:
            self.blockage.leans = dot(error_m, self.blockage.towards) > p.obstacles.lean_m
            self._follow(self.blockage, stands, wanted, passed_s)
        travel = _Travel.of(going, body.yaw_rad)
        by_leg = self._hits_leg(contact.leg, travel)
        hit = by_leg or self._hits_arm(contact.arms_nm, travel) or self._hits_body(travel)
        if hit is None:
            return False
        self._impulse_ns = 0j
        if self.blockage and self.blockage.retreats and dot(hit, self.blockage.towards) < 0.0:
            # There is an obstacle behind as well: stay between the two.
            self.blockage.retreats = False
            return True
        place_m = min((stand.position_m for stand in stands), key=lambda at_m: dot(at_m, hit))
        self.blockage = Blockage(hit, place_m, contact.leg if by_leg else None)
        return True

    def kept_off(self, foot_m: Point) -> Point:
        """
        Move a foothold to the near side of the obstacle that a leg has met.

        Parameters
        ----------
        foot_m
            Planned foothold, in the plane of the odom frame (m).

        Returns
        -------
        Point
            The foothold, moved straight back from the obstacle if it was too near to it or beyond.

        """
        blockage = self.blockage
        if blockage is None or blockage.leg is None:
            return foot_m
        way_m, p = foot_m - blockage.leg.foot_m, self._parameters
        slack_m = (
            p.obstacles.keep_off_slope * abs(cross(way_m, blockage.towards))
            - p.obstacles.keep_off_m
        )
        beyond_m = dot(way_m, blockage.towards) - slack_m
        return foot_m - max(0.0, beyond_m) * blockage.towards

    def allowed(self, wanted: VelocityCommand, heading_rad: float) -> VelocityCommand:
        """
        Limit the velocity to what the obstacle allows.

        While the robot retreats, the result is the velocity of stepping back, or zero if the robot
        leans towards the obstacle. Afterwards the part that leads into the obstacle is cut, and
        the whole linear velocity if little of it leads past the obstacle; the turn is kept.

        Parameters
        ----------
        wanted
            Commanded velocity, in the axes of the robot.
        heading_rad
            Yaw of the robot in the odom frame.

        Returns
        -------
        VelocityCommand
            Velocity in the axes of the robot; unchanged without an obstacle, or away from it.

        """
        blockage = self.blockage
        if blockage is None:
            return wanted
        ahead = cmath.rect(1.0, heading_rad)
        towards = blockage.towards / ahead
        if blockage.retreats and blockage.leans:
            return STANDING
        if blockage.retreats:
            back = -self._parameters.obstacles.retreat_m_s * towards
            return VelocityCommand(back.real, back.imag)
        speed = wanted.linear_m_s
        into = dot(speed, towards)
        if into <= 0.0:
            return wanted
        along = speed - into * towards
        if abs(along) < _ALONG * abs(speed):
            along = 0j
        return replace(wanted, forward_m_s=along.real, left_m_s=along.imag)

    def _hits_leg(self, leg: LegInAir | None, travel: _Travel) -> Point | None:
        """Compute the direction to an obstacle that stops the swing leg; None without one."""
        p, aside = self._parameters, travel.aside
        least_nm = (
            1.0 - aside
        ) * p.obstacles.leg_touch_nm + aside * p.obstacles.leg_touch_aside_nm
        if leg is None or travel.against(leg.push_nm) < least_nm:
            return None
        towards = travel.towards(leg.push_nm)
        known = self.blockage.leg if self.blockage and self._retreats_from(towards) else None
        return None if known and known.side == leg.side else towards

    def _hits_arm(self, arms_nm: Sequence[Point], travel: _Travel) -> Point | None:
        """Compute the direction to an obstacle that an arm touches; None without a new one."""
        for push_nm in arms_nm:
            against_nm = travel.against(push_nm) if travel.ahead else abs(push_nm)
            if travel.moves and against_nm > self._parameters.obstacles.arm_touch_nm:
                towards = travel.towards(push_nm)
                return None if self._retreats_from(towards) else towards
        return None

    def _retreats_from(self, towards: Point) -> bool:
        """Check whether the robot is retreating from an obstacle in this direction."""
        blockage = self.blockage
        return blockage is not None and blockage.retreats and dot(towards, blockage.towards) > 0.0

    def _hits_body(self, travel: _Travel) -> Point | None:
        """Compute the direction to an obstacle that has held up the robot; None without one."""
        least_ns = self._parameters.obstacles.bump_ns
        if not travel.moves or abs(self._impulse_ns) < least_ns:
            return None
        if travel.ahead and travel.against(self._impulse_ns) < least_ns / 2:
            return None
        return travel.towards(self._impulse_ns)

    def _follow(
        self,
        blockage: Blockage,
        stands: tuple[PlanarPose, PlanarPose],
        wanted: VelocityCommand,
        passed_s: float,
    ) -> None:
        """Advance the retreat, and forget an obstacle that the robot no longer approaches."""
        p = self._parameters
        blockage.elapsed_s += passed_s
        ways_m = [stand.position_m - blockage.place_m for stand in stands]
        # The robot will stand beside the foot that is farther away.
        left_m = p.obstacles.retreat_m + min(dot(way_m, blockage.towards) for way_m in ways_m)
        if left_m < p.obstacles.retreat_m / 2 or blockage.elapsed_s > p.obstacles.retreat_s:
            blockage.retreats = False
        heading = cmath.rect(1.0, stands[0].halfway(stands[1]).yaw_rad)
        into = dot(wanted.linear_m_s * heading, blockage.towards)
        blockage.let_go_s = blockage.let_go_s + passed_s if into < _STILL_M_S else 0.0
        is_over = blockage.let_go_s > p.obstacles.let_go_s and not blockage.retreats
        if is_over or abs(sum(ways_m) / 2) > p.obstacles.forget_m:
            self.blockage = None
