# SPDX-License-Identifier: Apache-2.0
"""The behaviour that waits for a duration."""

from __future__ import annotations

from typing import Any

from nav2_behaviors.timed_behavior import duration_message, seconds, TimedBehavior
from nav2_msgs.action import Wait as WaitAction

__all__ = ['Wait']


class Wait(TimedBehavior):
    """Behaviour that keeps the robot waiting for a duration."""

    action = WaitAction

    def time_allowance_s(self, goal: Any) -> float:
        """
        Return 0: the duration of the wait is the only limit.

        Parameters
        ----------
        goal
            The goal message of the action.

        """
        return 0.0

    def begin(self, goal: Any) -> None:
        """
        Record how long to wait.

        Parameters
        ----------
        goal
            The goal of the action, with its duration.

        """
        self._duration_s = seconds(goal.time)

    def step(self, elapsed_s: float) -> bool:
        """
        Publish the remaining time as feedback.

        Parameters
        ----------
        elapsed_s
            The time since the start of the goal, in s of the node's clock.

        Returns
        -------
        bool
            Whether the time is over.

        """
        left_s = max(self._duration_s - elapsed_s, 0.0)
        self.server.publish_feedback(WaitAction.Feedback(time_left=duration_message(left_s)))
        return left_s == 0.0
