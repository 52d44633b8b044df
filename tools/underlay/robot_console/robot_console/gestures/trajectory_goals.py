# SPDX-License-Identifier: Apache-2.0
"""Goals of several trajectory controllers that run together, and fail together."""

from __future__ import annotations

from collections.abc import Mapping
import math
from typing import Any
import uuid

from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Duration
from control_msgs.action import FollowJointTrajectory
from control_msgs.msg import JointTolerance
from robot_console.gestures.gesture_plan import Motion
from robot_console.service_calls import ServiceCalls
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

__all__ = ['TrajectoryGoals', 'trajectory_goal']

IMPL = FollowJointTrajectory.Impl
ANSWER_S = 5.0
RESULT_S = 3600.0
"""The time that a trajectory may take: a simulator may run slowly, or be paused."""
LATE_S = 2.0
"""How much longer than planned a robot may take to arrive, in its own time."""


def trajectory_goal(motion: Motion, tolerance: float) -> FollowJointTrajectory.Goal:
    """
    Build the goal of a controller, which starts at once.

    Parameters
    ----------
    motion
        The trajectory.
    tolerance
        How far a joint may be off on the way, in rad or m, before the controller gives up; 0 for
        what the controller tolerates.

    """
    still = [0.0] * len(motion.joints)
    points = [
        JointTrajectoryPoint(
            positions=list(positions), velocities=still, time_from_start=_duration(time_s)
        )
        for time_s, positions in motion.points
    ]
    return FollowJointTrajectory.Goal(
        trajectory=JointTrajectory(joint_names=list(motion.joints), points=points),
        path_tolerance=[
            JointTolerance(name=joint, position=tolerance) for joint in motion.joints if tolerance
        ],
        goal_time_tolerance=_duration(LATE_S),
    )


def _duration(time_s: float) -> Duration:
    whole_s = math.floor(time_s)
    return Duration(sec=whole_s, nanosec=int((time_s - whole_s) * 1e9))


class TrajectoryGoals:
    """
    The goals of one gesture; if one fails, or on request, all are canceled.

    Parameters
    ----------
    calls
        Calls the services of the actions.
    goals
        The goals, by the full names of their actions; they are sent at once.

    Attributes
    ----------
    failure
        The first failure, as a sentence; '' if there is none.

    """

    def __init__(
        self, calls: ServiceCalls, goals: Mapping[str, FollowJointTrajectory.Goal]
    ) -> None:
        self.failure = ''
        self._calls = calls
        self._is_canceled = False
        self._running = {action: list(uuid.uuid4().bytes) for action in goals}
        self._accepted: set[str] = set()
        for action, goal in goals.items():
            self._send(action, goal)

    @property
    def is_over(self) -> bool:
        """Whether all goals have ended."""
        return not self._running

    def cancel(self) -> None:
        """Cancel the goals: those that are not accepted yet as soon as they are."""
        self._is_canceled = True
        for action in self._accepted & set(self._running):
            self._cancel(action)

    def _send(self, action: str, goal: FollowJointTrajectory.Goal) -> None:
        request = IMPL.SendGoalService.Request(goal=goal)
        request.goal_id.uuid = self._running[action]

        def answer(response: Any, failed: str) -> None:
            if response is None:
                self._cancel(action)  # in case that only the response is lost
                self._fail(action, f'The gesture is not carried out: {failed}')
            elif not response.accepted:
                self._fail(action, f"'{action}' rejected the gesture. The robot's log says why.")
            else:
                self._accepted.add(action)
                self._ask_for_result(action)
                if self._is_canceled:
                    self._cancel(action)

        self._calls.call(
            IMPL.SendGoalService, f'{action}/_action/send_goal', request, answer, ANSWER_S
        )

    def _ask_for_result(self, action: str) -> None:
        request = IMPL.GetResultService.Request()
        request.goal_id.uuid = self._running[action]

        def answer(response: Any, failed: str) -> None:
            if response is None:
                self._fail(action, f'The end of the gesture is not known: {failed}')
            elif response.status != GoalStatus.STATUS_SUCCEEDED and not self._is_canceled:
                self._fail(action, _ending(action, response.status, response.result))
            else:
                self._running.pop(action, None)

        self._calls.call(
            IMPL.GetResultService, f'{action}/_action/get_result', request, answer, RESULT_S
        )

    def _cancel(self, action: str) -> None:
        request = IMPL.CancelGoalService.Request()
        request.goal_info.goal_id.uuid = self._running[action]

        def answer(response: Any, failed: str) -> None:
            if failed:
                self._running.pop(action, None)
                self.failure = self.failure or f'The gesture is not canceled: {failed}'

        self._calls.call(
            IMPL.CancelGoalService, f'{action}/_action/cancel_goal', request, answer, ANSWER_S
        )

    def _fail(self, action: str, reason: str) -> None:
        """End one goal with a failure, and cancel the others."""
        self._running.pop(action, None)
        if not self._is_canceled:
            self.failure = self.failure or reason
            self.cancel()


def _ending(action: str, status: int, result: Any) -> str:
    """Explain why a goal has ended early."""
    if status == GoalStatus.STATUS_CANCELED:
        return f"Another program canceled the goal of '{action}'."
    reason = str(result.error_string).rstrip('.')
    return f"'{action}' ended the gesture: {reason or f'error {result.error_code}'}."
