# SPDX-License-Identifier: Apache-2.0
"""Where the feet go for a velocity."""

from __future__ import annotations

import cmath
from collections.abc import Iterator
from dataclasses import dataclass

from humanoid_control.dynamics.rotations import wrap_angle
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.planar import limited, PlanarPose, Point
from humanoid_control.walking.sides import other, outwards
from humanoid_control.walking.velocity_command import VelocityCommand


@dataclass(frozen=True)
class Footstep:
    """A foot that is planned to stand somewhere."""

    side: int
    pose: PlanarPose


@dataclass(frozen=True)
class FootstepPlanner:
    """Puts one foot before the other, without crossing them."""

    parameters: WalkParameters

    def next_foot(self, support: PlanarPose, side: int, command: VelocityCommand) -> PlanarPose:
        """Return where the foot lands that swings while the foot of a side supports the robot."""
        start = self.middle_beside(support, side)
        return self.landing(support, side, self.next_middle(start, side, command))

    def middle_beside(self, support: PlanarPose, side: int) -> PlanarPose:
        """Return the middle between the feet if the other one stood beside a support."""
        half_width_m = self.parameters.step_width_m / 2 * outwards(side)
        return PlanarPose(support.at(0.0, -half_width_m), support.yaw_rad)

    def next_middle(
        self,
        middle: PlanarPose,
        side: int,
        command: VelocityCommand,
        time_s: float | None = None,
    ) -> PlanarPose:
        """
        Return where the middle between the feet goes in a step on the foot of a side.

        Sideways and in turns the foot on the side of the motion does the whole way of two
        steps, and the other one closes up: so they never cross.

        :param time_s: how long the step takes; without it, as long as planned
        """
        step_s = self.parameters.step_s if time_s is None else time_s
        leads = outwards(other(side))
        left_m, turn_rad = (
            2 * speed * step_s if speed * leads > 0 else 0.0
            for speed in (command.left_m_s, command.turn_rad_s)
        )
        way_m = complex(command.forward_m_s * step_s, left_m)
        heading = cmath.rect(1.0, middle.yaw_rad + turn_rad / 2)
        return PlanarPose(middle.position_m + way_m * heading, middle.yaw_rad + turn_rad)

    def landing(self, support: PlanarPose, side: int, middle: PlanarPose) -> PlanarPose:
        """Return where the foot lands so that the middle is in a place, as far as it can."""
        half_width_m = self.parameters.step_width_m / 2 * outwards(side)
        place = support.local(middle.at(0.0, -half_width_m))
        reached = self.reachable(place, side)
        return PlanarPose(support.at(reached.real, reached.imag), middle.yaw_rad)

    def reachable(self, place: Point, side: int) -> Point:
        """Return the place closest to one where a foot can go, seen from the support's side."""
        p, inwards = self.parameters, -outwards(side)
        width_m = limited(inwards * place.imag, p.least_width_m, p.most_width_m)
        length_m = limited(place.real, -p.most_length_m, p.most_length_m)
        return complex(length_m, inwards * width_m)

    def footsteps(
        self, landing: PlanarPose, support: int, command: VelocityCommand
    ) -> Iterator[Footstep]:
        """Yield the landing of the foot that swings now and those that follow, without end."""
        step = Footstep(other(support), landing)
        while True:
            yield step
            step = Footstep(other(step.side), self.next_foot(step.pose, step.side, command))

    def is_parallel(self, support: PlanarPose, side: int, foot: PlanarPose) -> bool:
        """Tell whether the other foot stands beside the support so that the robot may stop."""
        place = support.local(foot.position_m)
        width_m = -outwards(side) * place.imag
        return (
            abs(place.real) < self.parameters.parallel_length_m
            and abs(width_m - self.parameters.step_width_m) < self.parameters.parallel_width_m
            and abs(wrap_angle(foot.yaw_rad - support.yaw_rad)) < self.parameters.parallel_turn_rad
        )
