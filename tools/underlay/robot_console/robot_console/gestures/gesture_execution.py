# SPDX-License-Identifier: Apache-2.0
"""A gesture that a robot carries out: its goals, and its body poses at their times."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable

from robot_console.gestures.gesture_file import BodyPose, UPRIGHT
from robot_console.gestures.gesture_plan import GesturePlan
from robot_console.gestures.trajectory_goals import TrajectoryGoals

__all__ = ['GestureExecution']


class GestureExecution:
    """
    A gesture in progress. A body that was bent is upright again when the gesture ends early.

    Parameters
    ----------
    plan
        The plan of the gesture.
    goals
        The goals of its motions, which have just been sent.
    bend
        Commands a body pose.
    clock
        Returns the robot's time in s.

    Attributes
    ----------
    failure
        Why the gesture has ended early, as a sentence; '' if it has not, or was canceled.

    """

    def __init__(
        self,
        plan: GesturePlan,
        goals: TrajectoryGoals,
        bend: Callable[[BodyPose], None],
        clock: Callable[[], float],
    ) -> None:
        self.failure = ''
        self._goals, self._bend, self._clock = goals, bend, clock
        self._body = deque(plan.body)
        self._begin_s = clock()
        self._duration_s = plan.duration_s
        self._is_bent = self._is_canceled = False

    @property
    def is_over(self) -> bool:
        """Whether it has ended."""
        is_late = self._is_canceled or self._clock() - self._begin_s >= self._duration_s
        return self._goals.is_over and is_late

    def update(self) -> None:
        """Command the body poses that are due; end all of it if one goal has failed."""
        passed_s = self._clock() - self._begin_s
        if self._is_canceled:
            return
        if self._goals.failure:
            self.cancel(self._goals.failure)
        elif passed_s < 0.0:
            self.cancel("The robot's time was reset.")
        while self._body and passed_s >= self._body[0][0]:
            self._is_bent = True
            self._bend(self._body.popleft()[1])

    def cancel(self, failure: str = '') -> None:
        """
        Stop the joints where they are, and straighten the body.

        Parameters
        ----------
        failure
            Why, if nobody wanted it.

        """
        if self._is_canceled:
            return
        self._is_canceled, self.failure = True, failure
        self._body.clear()
        self._goals.cancel()
        if self._is_bent:
            self._bend(UPRIGHT)
