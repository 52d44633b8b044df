# SPDX-License-Identifier: Apache-2.0
"""Path tracking around a square."""

from __future__ import annotations

from dataclasses import dataclass
import math

from humanoid_control.dynamics.rotations import wrap_angle
from humanoid_control.walking.planar import limited, PlanarPose
from humanoid_control.walking.velocity_command import STANDING, VelocityCommand

CORNERS = 4
_GAIN_1_S = 1.0
"""Proportional gain of position and heading errors."""
_SLOWEST_SHARE = 0.3
"""Fraction of the speed that is left just before a corner."""


@dataclass(frozen=True)
class SquarePlan:
    """Size of the square, speeds and tolerances."""

    side_m: float = 1.0
    speed_m_s: float = 0.2
    turn_rad_s: float = 0.4
    sideways_m_s: float = 0.06
    reached_m: float = 0.03
    aligned_rad: float = 0.05


@dataclass(frozen=True)
class Corner:
    """A reached corner: its number from 1 on, its pose, and that of the robot."""

    number: int
    planned: PlanarPose
    actual: PlanarPose

    @property
    def error_m(self) -> float:
        """Return the distance of the robot from the corner."""
        return abs(self.actual.position_m - self.planned.position_m)


class SquareDrive:
    """
    Path tracking controller for a square to the left of the start, which is also its end.

    The robot walks along a side to its corner, and turns there to the next side. Both are closed
    loops: lateral and heading errors are corrected.

    Parameters
    ----------
    start
        Pose of the robot at the start; the first side is straight ahead of it.
    plan
        Size of the square, speeds and tolerances.

    """

    def __init__(self, start: PlanarPose, plan: SquarePlan) -> None:
        self._plan = plan
        self._sides = [_side(start, plan.side_m, number) for number in range(CORNERS)]
        self._number = 0
        self._turns = False

    @property
    def is_done(self) -> bool:
        """Whether the robot has completed the square."""
        return self._number == CORNERS

    def update(self, pose: PlanarPose) -> tuple[VelocityCommand, Corner | None]:
        """
        Compute the velocity command, and switch to the next turn or side when one is done.

        Parameters
        ----------
        pose
            Pose of the robot now, in the frame of the start.

        Returns
        -------
        tuple[VelocityCommand, Corner | None]
            The command in the axes of the robot, and the corner if it was reached just now.

        """
        if self.is_done:
            return STANDING, None
        side = self._sides[self._number]
        if not self._turns:
            if side.local(pose.position_m).real < -self._plan.reached_m:
                return self._along(side, pose), None
            self._turns = True
            return self._turn(side, pose), Corner(self._number + 1, side, pose)
        if abs(wrap_angle(_next_yaw(side) - pose.yaw_rad)) > self._plan.aligned_rad:
            return self._turn(side, pose), None
        self._number, self._turns = self._number + 1, False
        return self.update(pose)

    def _along(self, side: PlanarPose, pose: PlanarPose) -> VelocityCommand:
        """Compute the velocity command towards the corner at the end of a side."""
        plan, beside = self._plan, side.local(pose.position_m)
        return VelocityCommand(
            limited(-_GAIN_1_S * beside.real, _SLOWEST_SHARE * plan.speed_m_s, plan.speed_m_s),
            limited(-_GAIN_1_S * beside.imag, -plan.sideways_m_s, plan.sideways_m_s),
            self._towards(side.yaw_rad, pose),
        )

    def _turn(self, side: PlanarPose, pose: PlanarPose) -> VelocityCommand:
        """Compute the velocity command that turns to the next side and stays at the corner."""
        most, away = self._plan.sideways_m_s, pose.local(side.position_m)
        return VelocityCommand(
            limited(_GAIN_1_S * away.real, -most, most),
            limited(_GAIN_1_S * away.imag, -most, most),
            self._towards(_next_yaw(side), pose),
        )

    def _towards(self, yaw_rad: float, pose: PlanarPose) -> float:
        """Compute the yaw rate towards a heading."""
        most = self._plan.turn_rad_s
        return limited(_GAIN_1_S * wrap_angle(yaw_rad - pose.yaw_rad), -most, most)


def _side(start: PlanarPose, length_m: float, number: int) -> PlanarPose:
    """Return the corner at the end of a side, with the heading of the side."""
    corners = ((1, 0), (1, 1), (0, 1), (0, 0))
    forward, left = corners[number]
    heading_rad = start.yaw_rad + number * math.pi / 2
    return PlanarPose(start.at(forward * length_m, left * length_m), wrap_angle(heading_rad))


def _next_yaw(side: PlanarPose) -> float:
    """Return the heading of the next side."""
    return wrap_angle(side.yaw_rad + math.pi / 2)
