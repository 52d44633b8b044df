# SPDX-License-Identifier: Apache-2.0
"""Controllers that run goals: their base class, and which of a robot accept goals or lose them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from typing import Any, ClassVar, Generic, TYPE_CHECKING, TypeVar

from humanoid_control.backends import JointLimits, JointTargets, Observation
from humanoid_control.controllers.claims import JointClaims
from humanoid_control.controllers.commands import CommandError, JointNames
from humanoid_control.controllers.interface import Mask
from humanoid_control.controllers.modes import Still
from humanoid_control.controllers.trajectory_goal import (
    checked_goal,
    TrajectoryGoal,
    TrajectoryRequest,
)
import numpy as np

if TYPE_CHECKING:
    from humanoid_control.controllers.gripper_controller import Grip, GripperController
    from humanoid_control.controllers.joint_trajectory_controller import JointTrajectoryController

HELD = 'The robot must hold still; stop_state says why.'
PREEMPTED = 'A newer goal took its place.'
CANCELED = 'Canceled: the joints are held where they were.'
RESTARTED = 'The robot was reset, or its mode changed.'
DEACTIVATED = 'The controller was deactivated.'

GoalT = TypeVar('GoalT')
ResultT = TypeVar('ResultT')


class GoalController(ABC, Generic[GoalT, ResultT]):
    """
    Controller that runs one goal at a time on the joints that it claims.

    It claims them with its first goal and keeps them until it is deactivated, the robot is reset
    or its mode changes: reached positions are held.

    Parameters
    ----------
    name
        Name of the controller, as shown to users.
    joints
        All joints of the robot, in the order of its targets.
    own
        The joints of the controller; a goal moves all of them.

    Attributes
    ----------
    indices
        Indices (m,) of its own joints among all.
    is_active
        Whether it accepts goals; initially true.

    """

    way_out = 'deactivate that controller (ros2 control switch_controllers --deactivate)'
    kind: ClassVar[str]
    """The controller type that clients look for."""

    def __init__(self, name: str, joints: Sequence[str], own: Sequence[str]) -> None:
        self.name, self.joints, self.own = name, tuple(joints), tuple(own)
        self.indices = np.array([self.joints.index(joint) for joint in own], dtype=np.intp)
        self.is_active = True
        self._mask = np.zeros(len(self.joints), dtype=np.bool_)
        self._mask[self.indices] = True
        self._none = np.zeros_like(self._mask)
        self._claims = self._starts = False
        self._goal: GoalT | None = None
        self._done: Callable[[ResultT], None] = _nobody
        rest = np.zeros(len(self.joints))
        self._targets = JointTargets(rest, rest.copy(), rest.copy())

    @property
    def has_goal(self) -> bool:
        """Whether a goal is running, or starts in the next period."""
        return self._goal is not None

    @property
    def waits(self) -> bool:
        """Whether `start` is to be called, even if it has its joints already."""
        return self._starts

    def accept(self, goal: GoalT, done: Callable[[ResultT], None]) -> None:
        """
        Accept a goal, which starts in the next period and preempts the running one.

        Parameters
        ----------
        goal
            A goal that has been checked.
        done
            Called once with the result when the goal has ended, however it ends.

        """
        self.abort(PREEMPTED)
        self._goal, self._done = goal, done
        self._claims = self._starts = True

    def cancel_goal(self) -> None:
        """Cancel the goal for its client, and hold the joints at their last targets."""
        self._end(self._ended(CANCELED, True))

    def abort(self, why: str) -> None:
        """
        Abort the goal; from the next period on the joints are held at their last targets.

        Has no effect without a goal. Joints that another controller has claimed are held once they
        are released.

        Parameters
        ----------
        why
            Message for the client of the goal.

        """
        self._end(self._ended(why, False))

    def release(self, why: str) -> None:
        """
        Abort the running goal, if any, and release the claimed joints.

        Parameters
        ----------
        why
            Message for the client of the goal.

        """
        self.abort(why)
        self._claims = self._starts = False

    def cancel(self) -> None:
        """Abort the goal and release the joints, as on a reset or a mode change."""
        self.release(RESTARTED)

    def wanted(self, now_s: float) -> Mask:
        """
        Return the mask of claimed joints: its own from the first goal until `release`, else none.

        Parameters
        ----------
        now_s
            Not used: a claim does not expire.

        Returns
        -------
        Mask
            Over all joints (n,).

        """
        return self._mask if self._claims else self._none

    @abstractmethod
    def start(self, observation: Observation, held: JointTargets) -> None:
        """
        Start the accepted goal, or hold the joints if there is none.

        Parameters
        ----------
        observation, held
            As for `Controller.start`.

        """

    @abstractmethod
    def update(self, observation: Observation) -> JointTargets:
        """
        Compute the targets of the period, and end the goal once it succeeds or fails.

        Parameters
        ----------
        observation
            As for `Controller.update`.

        Returns
        -------
        JointTargets
            Targets of all n joints of the robot; only the entries of its own joints are valid.

        """

    @abstractmethod
    def _ended(self, why: str, is_canceled: bool) -> ResultT:
        """Build the result of a goal that was canceled or aborted from outside."""

    def _end(self, result: ResultT, stays: bool = False) -> None:
        """Send the result of the goal; hold the joints unless their targets stay as they are."""
        if self._goal is None:
            return
        done, self._done = self._done, _nobody
        self._goal = None
        self._starts = not stays
        self._forget()
        done(result)

    def _forget(self) -> None:
        """Clear the state of the goal that has ended."""


def _nobody(result: object) -> None:
    """Ignore the result: no client waits for it."""


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
