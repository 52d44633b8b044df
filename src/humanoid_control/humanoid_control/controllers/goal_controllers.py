# SPDX-License-Identifier: Apache-2.0
"""The controllers of a robot that accept goals: which ones they accept now, and which ones end."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from humanoid_control.backends import JointLimits
from humanoid_control.controllers.claims import JointClaims
from humanoid_control.controllers.commands import CommandError, JointNames
from humanoid_control.controllers.gripper_controller import Grip, GripperController
from humanoid_control.controllers.interface import GoalController
from humanoid_control.controllers.joint_trajectory_controller import JointTrajectoryController
from humanoid_control.controllers.modes import Still
from humanoid_control.controllers.trajectory_goal import (
    checked_goal,
    TrajectoryGoal,
    TrajectoryRequest,
)

HELD = 'The robot must hold still; stop_state says why.'


class GoalControllers:
    """
    The controllers that accept goals, those of limbs and of grippers.

    Parameters
    ----------
    names, limits
        All joints of the robot, and their limits.
    limbs, grippers
        The controllers.
    still
        Holds the joints while the robot must hold still; no goal is accepted then.
    claims
        The owners of the joints.

    Attributes
    ----------
    limbs, grippers
        Joint trajectory controllers of arms, head and waist, and gripper controllers, by name.
    by_name
        Both of them.

    """

    def __init__(
        self,
        names: JointNames,
        limits: JointLimits,
        limbs: Sequence[JointTrajectoryController],
        grippers: Sequence[GripperController],
        still: Still,
        claims: JointClaims,
    ) -> None:
        self._names, self._limits = names, limits
        self._still, self._claims = still, claims
        self.limbs = {each.name: each for each in limbs}
        self.grippers = {each.name: each for each in grippers}
        self.by_name: Mapping[str, GoalController[Any, Any]] = {**self.limbs, **self.grippers}

    def checked_goal(self, controller: str, request: TrajectoryRequest) -> TrajectoryGoal:
        """
        Validate a trajectory goal of a controller of arms, head or waist.

        Parameters
        ----------
        controller
            Name of the controller, one of `limbs`.
        request
            The goal that its client requests.

        Returns
        -------
        TrajectoryGoal
            The goal, which the controller can accept now.

        Raises
        ------
        CommandError
            The joints cannot execute it, the controller is inactive, the robot must hold still, or
            the joints belong to the mode or to a controller of higher priority.

        """
        wanted = self.limbs[controller]
        goal = checked_goal(controller, wanted.own, self._names, self._limits, request)
        self._check_free(wanted)
        return goal

    def checked_grip(self, controller: str, gap_m: float, most_n: float) -> Grip:
        """
        Validate a goal of a gripper controller.

        Parameters
        ----------
        controller
            Name of the controller, one of `grippers`.
        gap_m
            Gap between the fingers.
        most_n
            Maximum force; 0 is that of the actuator.

        Returns
        -------
        Grip
            The goal within the limits of the gripper, which the controller can accept now.

        Raises
        ------
        CommandError
            The gap or the force is out of range, or the reasons of `checked_goal`.

        """
        wanted = self.grippers[controller]
        grip = wanted.checked(gap_m, most_n)
        self._check_free(wanted)
        return grip

    def abort(self, reason: str) -> None:
        """
        Abort all goals.

        Parameters
        ----------
        reason
            Sentence for the clients.

        """
        for controller in self.by_name.values():
            controller.abort(reason)

    def end_lost(self) -> None:
        """End the goals of controllers whose joints others have taken."""
        claims, trouble = self._claims, self._claims.trouble
        for controller in self.by_name.values():
            if trouble:
                controller.release(f'{trouble[:1].upper()}{trouble[1:]}.')
            elif controller.has_goal and not claims.owns(controller, controller.indices):
                owners = {claims.owner(joint) for joint in controller.own}
                others = ', '.join(f"'{name}'" for name in sorted(owners - {controller.name}))
                controller.abort(f'Its joints were claimed by {others}.')

    def _check_free(self, controller: GoalController[Any, Any]) -> None:
        """Check that a controller can claim its joints now."""
        if not controller.is_active:
            raise CommandError(
                f"'{controller.name}' is inactive. Activate it: ros2 control switch_controllers "
                f'--activate {controller.name}'
            )
        if self._still.on:
            raise CommandError(HELD)
        self._claims.check(controller, controller.indices)
