# SPDX-License-Identifier: Apache-2.0
"""Client of the action `execute_plan`, which notices when the executor is lost."""

from __future__ import annotations

from collections.abc import Callable
import json
from typing import Any

from action_msgs.msg import GoalStatus
from humanoid_common.client_goals import cancel_goal
from humanoid_common.qos import LATCHED
from humanoid_interfaces.action import ExecutePlan
from humanoid_interfaces.msg import Plan as PlanMessage
from llm_planner.replanning import Failure
from rclpy.action import ActionClient
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import String

__all__ = ['ExecutorClient']

_ACCEPT_S, _SENDINGS = 3.0, 3
"""How long to wait for the response to a goal, and how often the goal is sent."""
_LOOK_S = 1.0
"""Period of the check whether the executor is still running."""
_CODES = ('INVALID', 'UNAVAILABLE', 'FAILED', 'TIMEOUT', 'STOPPED', 'PREEMPTED')


class _ExecutorLostError(Exception):
    """The executor ended before its plan was completed."""


class ExecutorClient:
    """
    Sends plans to the executor, one at a time, and gives them up if it ends or does not answer.

    Parameters
    ----------
    node
        The node that sends the plans.
    say
        Speaks a sentence to the user.

    """

    def __init__(self, node: Node, say: Callable[[str], None]) -> None:
        self._node, self._say = node, say
        self._sent: Any = None
        self._unanswered: dict[Future[Any], int] = {}
        """Futures of whether goals were answered, with the number of checks left to wait."""
        self._ends: set[Future[Any]] = set()
        self._run = ''
        self._client = ActionClient(node, ExecutePlan, 'execute_plan')
        node.create_subscription(String, 'executor/state', self._follow, LATCHED)
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._lookout = node.create_timer(_LOOK_S, self._look_for_executor, clock=steady)

    @property
    def is_ready(self) -> bool:
        """Whether an executor is running."""
        return bool(self._client.server_is_ready())

    async def execute(self, plan: PlanMessage) -> Failure | None:
        """
        Execute a plan; return its failure, or None if it succeeded or was given up.

        Parameters
        ----------
        plan
            What to do; its command and stamp identify it.

        """
        sent = await self._sent_goal(ExecutePlan.Goal(plan=plan))
        if sent is None:
            return None
        try:
            answer = await self._end_of(sent)
        except _ExecutorLostError as error:
            self._node.get_logger().warning(f'Giving up on {plan.command!r}. {error}')
            return None
        if answer is None:
            return None
        return _failure_of(answer.result) if answer.status == GoalStatus.STATUS_ABORTED else None

    def stop(self) -> None:
        """Cancel the current goal, even if it has only just been sent."""
        sent, self._sent = self._sent, None
        if sent is not None:
            cancel_goal(sent)

    async def _sent_goal(self, goal: ExecutePlan.Goal) -> Any:
        """
        Send a goal; return the completed future of its response, or None if it was given up.

        A goal without a response is sent again: an executor that was discovered only just now may
        not have discovered this node yet.
        """
        for _ in range(_SENDINGS):
            sent = self._sent = self._client.send_goal_async(goal)
            answered: Future[Any] = Future(executor=self._node.executor)
            self._unanswered[answered] = round(_ACCEPT_S / _LOOK_S)
            sent.add_done_callback(lambda _, told=answered: told.done() or told.set_result(True))
            is_answered = await answered
            self._unanswered.pop(answered, None)
            if self._sent is not sent:  # stopped, or superseded by a newer command
                return None
            if is_answered:
                return sent
            cancel_goal(sent)
        self._say('I cannot do anything, as the skill executor does not answer.')
        return None

    async def _end_of(self, sent: Any) -> Any:
        """
        Wait for the result of a goal that was sent; None if it was not accepted.

        Raises
        ------
        _ExecutorLostError
            The executor has ended, and can no longer respond.

        """
        end: Future[Any] = Future(executor=self._node.executor)

        def give(answered: Any) -> None:
            if not end.done():
                end.set_result(answered.result())

        def wait(accepted: Any) -> None:
            handle = accepted.result()
            if handle is not None and handle.accepted:
                handle.get_result_async().add_done_callback(give)
            elif not end.done():
                end.set_result(None)

        sent.add_done_callback(wait)
        self._ends.add(end)
        try:
            return await end
        finally:
            self._ends.discard(end)

    def _follow(self, message: String) -> None:
        """Detect that another executor is running."""
        try:
            run = json.loads(message.data)['run']
        except (ValueError, TypeError, KeyError):
            return
        before, self._run = self._run, run
        if before and before != run:  # the new one announces the interruption
            self._lose('The skill executor was restarted.')

    def _look_for_executor(self) -> None:
        """Detect that the executor has ended, or does not respond."""
        for answered in list(self._unanswered):
            self._unanswered[answered] -= 1
            if self._unanswered[answered] < 0 and not answered.done():
                answered.set_result(False)
        if not self.is_ready and self._lose('The skill executor has exited.'):
            self._say('I cannot continue, as the skill executor has exited.')

    def _lose(self, reason: str) -> bool:
        """Fail all waits for an executor that has ended; return whether there were any."""
        lost = [each for each in self._ends if not each.done()]
        for end in lost:
            end.set_exception(_ExecutorLostError(reason))
        return bool(lost)


def _failure_of(result: ExecutePlan.Result) -> Failure:
    """Convert the result of an aborted plan; an unknown error code becomes `UNKNOWN`."""
    kind = type(result)
    code = next((each for each in _CODES if getattr(kind, each) == result.error_code), 'UNKNOWN')
    return Failure(code, result.failed_step, result.error_msg)
