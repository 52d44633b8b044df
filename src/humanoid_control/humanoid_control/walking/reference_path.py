# SPDX-License-Identifier: Apache-2.0
"""The way that the robot was told to go, from which its steps stray."""

from __future__ import annotations

from humanoid_control.dynamics.rotations import wrap_angle
from humanoid_control.walking.footsteps import FootstepPlanner
from humanoid_control.walking.planar import limited, PlanarPose
from humanoid_control.walking.velocity_command import VelocityCommand


class ReferencePath:
    """
    Path tracking: where the middle between the feet would be if all steps landed as planned.

    Steps that land a little off would add up to a drift; so each one is planned from a place
    between where the robot is and this reference path. The path stays near the robot: a push that
    moves it farther is not made up for.

    Parameters
    ----------
    planner
        Plans the footsteps; its parameters have the gain and the limits of the tracking.

    """

    def __init__(self, planner: FootstepPlanner) -> None:
        self._planner = planner
        self._middle: PlanarPose | None = None

    def restart(self) -> None:
        """Forget the way: the next one begins where the robot is."""
        self._middle = None

    def corrected(self, middle: PlanarPose) -> PlanarPose:
        """
        Correct the start of the next step towards the reference path.

        The first call starts the path. It is kept within `path_distance_m` and `path_turn_rad`
        of the robot, so that large pushes are not made up for.

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

    def advance(self, support: int, command: VelocityCommand, time_s: float) -> None:
        """
        Advance the reference path by one step; without effect before the path has started.

        Parameters
        ----------
        support
            Side of the foot that carried the robot during the step.
        command
            Velocity of the step, in the axes of the robot.
        time_s
            Actual duration of the step.

        """
        if self._middle is not None:
            self._middle = self._planner.next_middle(self._middle, support, command, time_s)
