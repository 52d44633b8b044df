# SPDX-License-Identifier: Apache-2.0
"""Interfaces of the controllers of a robot, and the base class of those that run goals."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from typing import ClassVar, Generic, Protocol, TypeVar

from humanoid_control.backends import JointTargets, Observation
import numpy as np
from numpy.typing import NDArray

Mask = NDArray[np.bool_]

PREEMPTED = 'A newer goal took its place.'
CANCELED = 'Canceled: the joints are held where they were.'
RESTARTED = 'The robot was reset, or its mode changed.'
DEACTIVATED = 'The controller was deactivated.'

GoalT = TypeVar('GoalT')
ResultT = TypeVar('ResultT')


class Controller(Protocol):
    """Controller of joints; the manager assigns each joint to exactly one controller."""

    @property
    def name(self) -> str:
        """Return the name shown to users."""

    @property
    def joints(self) -> tuple[str, ...]:
        """Return the joints that it moves, in the order of its targets."""

    def start(self, observation: Observation, held: JointTargets) -> None:
        """
        Start controlling joints from their current targets.

        The manager calls it before `update`: for the controller of a mode when the mode is
        entered, for a `ClaimingController` when it is assigned joints, or has some and `waits`.

        Parameters
        ----------
        observation
            Sensor values of the current period.
        held
            Targets of all joints to continue from: those of the last period, extrapolated to now
            at their velocities; initially the measured positions, at rest.

        """

    def update(self, observation: Observation) -> JointTargets:
        """
        Compute the joint targets for the coming period. Call once per control period.

        Parameters
        ----------
        observation
            Sensor values of the current period.

        Returns
        -------
        JointTargets
            Targets of its n joints, in their order, each array (n,). The manager ignores those of
            joints that belong to another controller.

        """


class ClaimingController(Controller, Protocol):
    """Controller that claims joints for as long as it has commands for them."""

    @property
    def way_out(self) -> str:
        """Return a way to free its joints for another controller, to end an error message."""

    @property
    def waits(self) -> bool:
        """Whether `start` is to be called, even if it has its joints already."""

    def wanted(self, now_s: float) -> Mask:
        """
        Compute the mask of joints that it has commands for and therefore claims.

        Parameters
        ----------
        now_s
            The robot's time.

        Returns
        -------
        Mask
            Over all joints (n,).

        """

    def cancel(self) -> None:
        """Drop all commands."""


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
