# SPDX-License-Identifier: Apache-2.0
"""Footstep planning for a velocity command, and tracking of the commanded path."""

from __future__ import annotations

import cmath
from collections.abc import Iterator
from dataclasses import dataclass

from humanoid_control.walking.commands import VelocityCommand
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.planar import limited, other, outwards, PlanarPose, Point
from humanoid_description.rotations import wrap_angle


@dataclass(frozen=True)
class Footstep:
    """Planned footstep: the side of the foot, and the pose of its sole."""

    side: int
    pose: PlanarPose


@dataclass(frozen=True)
class FootstepPlanner:
    """Footstep planner that follows a velocity without crossing the feet."""

    parameters: WalkParameters

    def next_foot(self, support: PlanarPose, side: int, velocity: VelocityCommand) -> PlanarPose:
        """
        Plan the landing of the swing foot at a velocity.

        Parameters
        ----------
        support
            Pose of the support foot, in the odom frame.
        side
            Side of the support foot.
        velocity
            Velocity in the axes of the robot.

        Returns
        -------
        PlanarPose
            Pose of the swing foot after landing, in the odom frame.

        """
        start = self.middle_beside(support, side)
        return self.landing(support, side, self.next_middle(start, side, velocity))

    def middle_beside(self, support: PlanarPose, side: int) -> PlanarPose:
        """
        Compute the middle between the feet as if the swing foot stood beside the support foot.

        Parameters
        ----------
        support
            Pose of the support foot, in the odom frame.
        side
            Side of the support foot.

        Returns
        -------
        PlanarPose
            Middle between the feet in the odom frame, with the heading of the support foot.

        """
        half_width_m = self.parameters.footsteps.width_m / 2 * outwards(side)
        return PlanarPose(support.at(0.0, -half_width_m), support.yaw_rad)

    def next_middle(
        self,
        middle: PlanarPose,
        side: int,
        velocity: VelocityCommand,
        time_s: float | None = None,
    ) -> PlanarPose:
        """
        Compute the middle between the feet after one step at a velocity.

        Sideways and in turns the foot on the side of the motion covers the distance of two steps,
        and the other one closes up, so that they never cross.

        Parameters
        ----------
        middle
            Middle between the feet before the step, in the odom frame.
        side
            Side of the support foot.
        velocity
            Velocity in the axes of the robot.
        time_s
            Duration of the step; by default the planned one.

        Returns
        -------
        PlanarPose
            Middle between the feet after the step, in the odom frame.

        """
        step_s = self.parameters.timing.step_s if time_s is None else time_s
        leads = outwards(other(side))
        left_m, turn_rad = (
            2 * speed * step_s if speed * leads > 0 else 0.0
            for speed in (velocity.left_m_s, velocity.turn_rad_s)
        )
        way_m = complex(velocity.forward_m_s * step_s, left_m)
        heading = cmath.rect(1.0, middle.yaw_rad + turn_rad / 2)
        return PlanarPose(middle.position_m + way_m * heading, middle.yaw_rad + turn_rad)

    def landing(self, support: PlanarPose, side: int, middle: PlanarPose) -> PlanarPose:
        """
        Compute the landing of the swing foot that puts the middle between the feet at a pose.

        The position is clamped to what the foot can reach; the heading is that of `middle`.

        Parameters
        ----------
        support
            Pose of the support foot, in the odom frame.
        side
            Side of the support foot.
        middle
            Wanted middle between the feet, in the odom frame.

        Returns
        -------
        PlanarPose
            Pose of the swing foot after landing, in the odom frame.

        """
        half_width_m = self.parameters.footsteps.width_m / 2 * outwards(side)
        place = support.local(middle.at(0.0, -half_width_m))
        reached = self.reachable(place, side)
        return PlanarPose(support.at(reached.real, reached.imag), middle.yaw_rad)

    def reachable(self, place: Point, side: int) -> Point:
        """
        Clamp a landing position to the rectangle that the swing foot can reach.

        Parameters
        ----------
        place
            Position (m) in the frame of the support sole: ahead (real), to the left (imaginary).
        side
            Side of the support foot.

        Returns
        -------
        Point
            Closest reachable position in m, in the frame of the support sole.

        """
        p, inwards = self.parameters, -outwards(side)
        width_m = limited(
            inwards * place.imag, p.footsteps.least_width_m, p.footsteps.most_width_m
        )
        length_m = limited(place.real, -p.footsteps.most_length_m, p.footsteps.most_length_m)
        return complex(length_m, inwards * width_m)

    def footsteps(
        self, landing: PlanarPose, support: int, velocity: VelocityCommand
    ) -> Iterator[Footstep]:
        """
        Generate an endless sequence of footsteps that starts with the landing of the swing foot.

        Parameters
        ----------
        landing
            Pose at which the swing foot lands, in the odom frame.
        support
            Side of the foot that carries the robot until then.
        velocity
            Velocity of all the steps that follow, in the axes of the robot.

        Yields
        ------
        Footstep
            Landings of the swing foot and of those after it, in the odom frame.

        """
        step = Footstep(other(support), landing)
        while True:
            yield step
            step = Footstep(other(step.side), self.next_foot(step.pose, step.side, velocity))

    def is_parallel(self, support: PlanarPose, side: int, foot: PlanarPose) -> bool:
        """
        Check whether the feet stand side by side, so that the robot may stop.

        Parameters
        ----------
        support
            Pose of the support foot, in the odom frame.
        side
            Side of the support foot.
        foot
            Pose of the other foot, in the odom frame.

        """
        place = support.local(foot.position_m)
        width_m = -outwards(side) * place.imag
        return (
            abs(place.real) < self.parameters.footsteps.parallel_length_m
            and abs(width_m - self.parameters.footsteps.width_m)
            < self.parameters.footsteps.parallel_width_m
            and abs(wrap_angle(foot.yaw_rad - support.yaw_rad))
            < self.parameters.footsteps.parallel_turn_rad
        )


class ReferencePath:
    """
    Reference path: the middle between the feet as if all steps landed as planned.

    The errors of landings would add up to a drift; therefore each step is planned from a pose
    between that of the robot and this path. The path stays near the robot: larger displacements,
    as by a push, are not corrected.

    Parameters
    ----------
    planner
        Footstep planner; its parameters have the gain and the limits of the tracking.

    """

    def __init__(self, planner: FootstepPlanner) -> None:
        self._planner = planner
        self._middle: PlanarPose | None = None

    def restart(self) -> None:
        """Discard the path: the next one starts where the robot is."""
        self._middle = None

    def corrected(self, middle: PlanarPose) -> PlanarPose:
        """
        Correct the start of the next step towards the reference path.

        The first call starts the path. It is kept within `path_distance_m` and `path_turn_rad`
        of the robot, so that larger displacements by pushes are not corrected.

        Parameters
        ----------
        middle
            Middle between the feet at the start of the step, in the odom frame.

        Returns
        -------
        PlanarPose
            Pose to plan from, in the odom frame: a fraction `path_gain` of the way to the path.

        """
        p = self._planner.parameters
        if self._middle is None:
            self._middle = middle
        off_m = self._middle.position_m - middle.position_m
        off_m *= min(
            1.0, p.footsteps.path_distance_m / max(abs(off_m), p.footsteps.path_distance_m)
        )
        turn_rad = wrap_angle(self._middle.yaw_rad - middle.yaw_rad)
        turn_rad = limited(turn_rad, -p.footsteps.path_turn_rad, p.footsteps.path_turn_rad)
        self._middle = PlanarPose(middle.position_m + off_m, middle.yaw_rad + turn_rad)
        return PlanarPose(
            middle.position_m + p.footsteps.path_gain * off_m,
            middle.yaw_rad + p.footsteps.path_gain * turn_rad,
        )

    def advance(self, support: int, velocity: VelocityCommand, time_s: float) -> None:
        """
        Advance the reference path by one step; without effect before the path has started.

        Parameters
        ----------
        support
            Side of the foot that carried the robot during the step.
        velocity
            Velocity of the step, in the axes of the robot.
        time_s
            Actual duration of the step.

        """
        if self._middle is not None:
            self._middle = self._planner.next_middle(self._middle, support, velocity, time_s)
