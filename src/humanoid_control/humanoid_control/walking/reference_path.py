# SPDX-License-Identifier: Apache-2.0
"""Path tracking: the commanded path, from which the steps deviate."""

from __future__ import annotations

from humanoid_control.dynamics.rotations import wrap_angle
from humanoid_control.walking.footsteps import FootstepPlanner
from humanoid_control.walking.planar import limited, PlanarPose
from humanoid_control.walking.velocity_command import VelocityCommand


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
