# SPDX-License-Identifier: Apache-2.0
"""A walk around a square, with reports of its progress."""

from __future__ import annotations

from dataclasses import dataclass
import math

from humanoid_control.dynamics.rotations import wrap_angle
from humanoid_control.walking.planar import PlanarPose
from humanoid_control.walking.velocity_command import STANDING, VelocityCommand
from humanoid_simulation.examples.square_drive import Corner, CORNERS, SquareDrive, SquarePlan

REST_S = 3.0
"""Time for the robot to come to rest before the closing error is measured."""
_PATIENCE = 4.0
"""Timeout of the walk, as a multiple of its planned duration."""


class NotRoundError(Exception):
    """The robot did not complete the square."""


@dataclass(frozen=True)
class Progress:
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
    ) -> Progress:
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
        Progress
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
                f'The robot has not come round in {_PATIENCE:g} times the planned time. Does '
                'anything else send cmd_vel, or is the robot stopped or hindered?'
            )
        command, corner = self._drive.update(odometry)
        if self._drive.is_done:
            self._rests_since_s = time_s
        return Progress(command, _arrival(corner) if corner else '')

    def _rest(self, time_s: float, odometry: PlanarPose, truth: PlanarPose) -> Progress:
        """Wait until the robot has come to rest, and report the closing errors."""
        assert self._rests_since_s is not None
        if time_s - self._rests_since_s < REST_S:
            return Progress(STANDING)
        by_odometry = _closing_error(self._odometry, odometry)
        by_truth = _closing_error(self._truth, truth)
        news = f'Round. Closing error: {by_truth} on ground truth, {by_odometry} by odometry'
        return Progress(STANDING, news, is_done=True)


def _arrival(corner: Corner) -> str:
    """Format the message that a corner was reached."""
    place = corner.actual.position_m
    return (
        f'Corner {corner.number} of {CORNERS}: ({place.real:.2f}, {place.imag:.2f}) m, '
        f'{100 * corner.error_m:.0f} cm from where it is'
    )


def _closing_error(begin: PlanarPose, end: PlanarPose) -> str:
    """Format the distance and the rotation from the start to the end pose."""
    turned_deg = math.degrees(wrap_angle(end.yaw_rad - begin.yaw_rad))
    return f'{100 * abs(end.position_m - begin.position_m):.0f} cm and {turned_deg:+.0f} degrees'


def _planned_s(plan: SquarePlan) -> float:
    """Estimate the duration of an unobstructed walk."""
    side_s = plan.side_m / plan.speed_m_s + math.pi / 2 / plan.turn_rad_s
    return CORNERS * (side_s + 2.0)
