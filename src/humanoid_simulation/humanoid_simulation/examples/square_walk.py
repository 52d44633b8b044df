# SPDX-License-Identifier: Apache-2.0
"""A walk around a square: path tracking, and reports of its progress."""

from __future__ import annotations

from dataclasses import dataclass
import math

from humanoid_common.errors import UserError
from humanoid_control.walking.commands import STANDING, VelocityCommand
from humanoid_control.walking.planar import limited, PlanarPose
from humanoid_description.rotations import wrap_angle

REST_S = 3.0
"""Time for the robot to come to rest before the closing error is measured."""
_PATIENCE = 4.0
"""Timeout of the walk, as a multiple of its planned duration."""
CORNERS = 4
_GAIN_1_S = 1.0
"""Proportional gain of position and heading errors."""
_SLOWEST_SHARE = 0.3
"""Fraction of the speed that is left just before a corner."""


class NotRoundError(UserError):
    """The robot did not complete the square."""


@dataclass(frozen=True)
class WalkUpdate:
    """The velocity command, what to report, and whether the walk is done."""

    command: VelocityCommand
    news: str = ''
    is_done: bool = False


class SquareWalk:
    """
    Controller of a walk around a square by odometry; reports the closing errors.

    Parameters
    ----------
    plan
        Size of the square, speeds and tolerances.
    time_s
        Simulated time at the start.
    odometry, truth
        Pose at the start, by odometry and in the world.

    """

    def __init__(
        self, plan: SquarePlan, time_s: float, odometry: PlanarPose, truth: PlanarPose
    ) -> None:
        self._drive = SquareDrive(odometry, plan)
        self._odometry = odometry
        self._truth = truth
        self._give_up_s = time_s + _PATIENCE * _planned_s(plan)
        self._rests_since_s: float | None = None

    def update(
        self, time_s: float, odometry: PlanarPose, truth: PlanarPose, stands: bool
    ) -> WalkUpdate:
        """
        Compute the velocity command and the progress of the walk.

        Parameters
        ----------
        time_s
            Simulated time now.
        odometry, truth
            Pose by odometry, which steers, and the true one, for the closing error.
        stands
            Whether the robot stands.

        Returns
        -------
        WalkUpdate
            The velocity command, and what to report.

        Raises
        ------
        NotRoundError
            The robot fell, or takes far longer than planned.

        """
        if not stands:
            raise NotRoundError('The robot fell. Reset the simulation and walk more slowly.')
        if self._rests_since_s is not None:
            return self._rest(time_s, odometry, truth)
        if time_s > self._give_up_s:
            raise NotRoundError(
                f'The robot has not completed the square in {_PATIENCE:g} times the planned time. '
                'Is another node publishing cmd_vel, or is the robot stopped or blocked?'
            )
        command, corner = self._drive.update(odometry)
        if self._drive.is_done:
            self._rests_since_s = time_s
        return WalkUpdate(command, _arrival(corner) if corner else '')

    def _rest(self, time_s: float, odometry: PlanarPose, truth: PlanarPose) -> WalkUpdate:
        """Wait until the robot has come to rest, and report the closing errors."""
        assert self._rests_since_s is not None
        if time_s - self._rests_since_s < REST_S:
            return WalkUpdate(STANDING)
        by_odometry = _closing_error(self._odometry, odometry)
        by_truth = _closing_error(self._truth, truth)
        news = (
            f'Square completed. Closing error: {by_truth} on ground truth, {by_odometry} by '
            'odometry'
        )
        return WalkUpdate(STANDING, news, is_done=True)


def _arrival(corner: Corner) -> str:
    """Format the message that a corner was reached."""
    place = corner.actual.position_m
    return (
        f'Corner {corner.number} of {CORNERS}: ({place.real:.2f}, {place.imag:.2f}) m, '
        f'{100 * corner.error_m:.0f} cm off'
    )


def _closing_error(begin: PlanarPose, end: PlanarPose) -> str:
    """Format the distance and the rotation from the start to the end pose."""
    turned_deg = math.degrees(wrap_angle(end.yaw_rad - begin.yaw_rad))
    return f'{100 * abs(end.position_m - begin.position_m):.0f} cm and {turned_deg:+.0f} degrees'


def _planned_s(plan: SquarePlan) -> float:
    """Estimate the duration of an unobstructed walk."""
    side_s = plan.side_m / plan.speed_m_s + math.pi / 2 / plan.turn_rad_s
    return CORNERS * (side_s + 2.0)


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
