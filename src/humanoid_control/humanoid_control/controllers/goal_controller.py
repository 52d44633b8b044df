# SPDX-License-Identifier: Apache-2.0
"""What controllers have in common that are given goals, and keep their joints behind them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from typing import ClassVar, Generic, TypeVar

from humanoid_control.backends import JointTargets, Observation
from humanoid_control.controllers.interface import Mask
import numpy as np

PREEMPTED = 'A newer goal took its place.'
CANCELED = 'Canceled: the joints are held where they were.'
RESTARTED = 'The robot was reset, or its mode changed.'
DEACTIVATED = 'The controller was deactivated.'

GoalT = TypeVar('GoalT')
ResultT = TypeVar('ResultT')


class GoalController(ABC, Generic[GoalT, ResultT]):
    """
    Controller that runs one goal at a time on the joints that it claims.

    It claims them with its first goal and keeps them until it is deactivated or the robot begins
    anew: what was reached stays.

    Parameters
    ----------
    name
        What users call the controller.
    joints
        All joints of the robot, in the order of its targets.
    own
        The joints that the controller moves, all at once.

    Attributes
    ----------
    indices
        Indices (m,) of its own joints among all.
    is_active
        Whether it may be given goals; it is active at the start.

    """

    way_out = 'deactivate that controller (ros2 control switch_controllers --deactivate)'
    kind: ClassVar[str]
    """Its type, by the name that clients look for."""

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
        """Whether a goal runs, or is to start with the next period."""
        return self._goal is not None

    @property
    def waits(self) -> bool:
        """Whether it is to be started, even if it has its joints already."""
        return self._starts

    def accept(self, goal: GoalT, done: Callable[[ResultT], None]) -> None:
        """
        Accept a goal, which starts in the next period and preempts the one that runs.

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
        """End the goal as its client asks; hold the joints where they were told to be last."""
        self._end(self._ended(CANCELED, True))

    def abort(self, why: str) -> None:
        """
        Abort the goal; from the next period on the joints are held at their last targets.

        Without a goal nothing changes. Joints that another controller has are held when they come
        back.

        Parameters
        ----------
        why
            Message for the client of the goal.

        """
        self._end(self._ended(why, False))

    def release(self, why: str) -> None:
        """
        Abort the goal, if one runs, and release the claimed joints.

        Parameters
        ----------
        why
            Message for the client of the goal.

        """
        self.abort(why)
        self._claims = self._starts = False

    def cancel(self) -> None:
        """Begin anew: no goal, no joints."""
        self.release(RESTARTED)

    def wanted(self, now_s: float) -> Mask:
        """
        Return the joints that it claims: its own from the first goal until `release`, then none.

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
            Of all n joints of the robot; only the entries of its own joints mean something.

        """

    @abstractmethod
    def _ended(self, why: str, is_canceled: bool) -> ResultT:
        """Return the result of a goal that is ended from outside."""

    def _end(self, result: ResultT, stays: bool = False) -> None:
        """Say how the goal ended; unless the joints stay as they are told now, hold them."""
        if self._goal is None:
            return
        done, self._done = self._done, _nobody
        self._goal = None
        self._starts = not stays
        self._forget()
        done(result)

    def _forget(self) -> None:
        """Drop what belongs to the goal that has ended."""


def _nobody(result: object) -> None:
    """Tell nobody."""
