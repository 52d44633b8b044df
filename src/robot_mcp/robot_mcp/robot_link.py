# SPDX-License-Identifier: Apache-2.0
"""Link from the server to the robot: send plans to `execute_plan`, and cancel them."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncGenerator, Callable
from dataclasses import dataclass, field
import time
from typing import Any
import uuid

from action_msgs.msg import GoalInfo
from action_msgs.srv import CancelGoal
from humanoid_common.goal_guard import GoalGuard, GuardedActionClient
from humanoid_common.qos import LATCHED
from humanoid_interfaces.action import ExecutePlan
from humanoid_interfaces.msg import Plan as PlanMessage
from humanoid_interfaces.srv import MakePlan
from rclpy.action import ActionClient
from rclpy.node import Node
from robot_mcp.deadlines import in_time
from robot_mcp.node_thread import in_loop, NodeThread, RobotError
from std_msgs.msg import String

__all__ = ['PlanEnd', 'PlanRun', 'RobotLink']

_ACCEPTANCE_S = 5.0
_PLAN_S = 25.0
_CHECK_S = 0.25
_LOST_S = 3.0
NO_EXECUTOR = 'I cannot do anything, as the skill executor is not running (llm_planner).'
NO_PLANNER = 'I cannot understand sentences, as the task planner is not running (llm_planner).'


@dataclass
class PlanRun:
    """A plan that was, or will be, sent; `is_canceled` may be set from any thread."""

    goal_id: Any = field(default_factory=lambda: _goal_id())
    is_canceled: bool = False
    is_sent: bool = False
    is_over: bool = False


@dataclass(frozen=True)
class PlanEnd:
    """The end of a plan: a status of `action_msgs/GoalStatus`, and the result."""

    status: int
    result: ExecutePlan.Result


class RobotLink:
    """
    The robot as the server sees it. Coroutines are for the thread of the server.

    Parameters
    ----------
    node
        The node that subscribes and sends goals.
    may_move
        Whether plans are sent. If so, those still being executed end with this process.

    """

    def __init__(self, node: Node, *, may_move: bool) -> None:
        self._node = node
        self.thread = NodeThread(node)
        self._guard = GoalGuard(node) if may_move else None
        self._client = (
            ActionClient(node, ExecutePlan, 'execute_plan')
            if self._guard is None
            else GuardedActionClient(self._guard, ExecutePlan, 'execute_plan')
        )
        # Independent of the action client: it has to work after that is destroyed, for all goals.
        self._canceling = node.create_client(CancelGoal, 'execute_plan/_action/cancel_goal')
        self._planner = node.create_client(MakePlan, 'task_planner/plan')
        self._runs: dict[bytes, PlanRun] = {}
        self.walking_state = self.plan_state = ''
        node.create_subscription(String, 'walking_state', self._take_walking, LATCHED)
        node.create_subscription(String, 'executor/state', self._take_plan, LATCHED)

    def _take_walking(self, message: String) -> None:
        self.walking_state = message.data

    def _take_plan(self, message: String) -> None:
        self.plan_state = message.data

    async def lack(self) -> str:
        """Explain why no plan can be executed now; empty if one can."""
        return '' if await self.thread.found(self._client.server_is_ready) else NO_EXECUTOR

    async def plan(self, sentence: str) -> MakePlan.Response:
        """
        Request a plan for a natural-language command from the task planner.

        Parameters
        ----------
        sentence
            The command.

        Returns
        -------
        MakePlan.Response
            The plan, or the reason why there is none.

        Raises
        ------
        RobotError
            The planner is not running, or does not respond.

        """
        if not await self.thread.found(self._planner.service_is_ready):
            raise RobotError(NO_PLANNER)
        return await self.thread.ask(
            self._planner, MakePlan.Request(command=sentence), 'The task planner', _PLAN_S
        )

    async def execute(
        self, plan: PlanMessage, run: PlanRun
    ) -> AsyncGenerator[ExecutePlan.Feedback | PlanEnd | None, None]:
        """
        Execute a plan, and yield the feedback of the executor.

        A caller that stops iterating early has to call `leave`.

        Parameters
        ----------
        plan
            The plan as a message.
        run
            A new `PlanRun`, by which the plan can be canceled.

        Yields
        ------
        ExecutePlan.Feedback, PlanEnd or None
            Feedback as it arrives, None periodically while there is none, and the end last.

        Raises
        ------
        RobotError
            The executor is not running, rejects the plan, does not respond, or ends during the
            plan; or the plan was canceled before it was sent.

        """
        # From here on a stop applies to it, although it has not been sent yet.
        self._runs[bytes(run.goal_id.uuid)] = run
        try:
            if lack := await self.lack():
                raise RobotError(lack)
            async for news in self._told_of(plan, run):
                yield news
        finally:
            if not run.is_sent:
                del self._runs[bytes(run.goal_id.uuid)]

    async def _told_of(
        self, plan: PlanMessage, run: PlanRun
    ) -> AsyncGenerator[ExecutePlan.Feedback | PlanEnd | None, None]:
        """Send a plan, and yield its feedback and its end."""
        loop = asyncio.get_running_loop()
        told: asyncio.Queue[Any] = asyncio.Queue()
        await self.thread.do(
            self._send, plan, run, lambda news: in_loop(loop, told.put_nowait, news)
        )
        there_s = time.monotonic()
        accepted_by_s = time.monotonic() + _ACCEPTANCE_S
        is_accepted = False
        while True:
            try:
                news = await in_time(told.get(), _CHECK_S)
            except asyncio.TimeoutError:
                if await self.thread.do(self._client.server_is_ready):
                    there_s = time.monotonic()
                if time.monotonic() > there_s + _LOST_S:
                    raise RobotError('The skill executor ended before it was done.') from None
                if not is_accepted and time.monotonic() > accepted_by_s:
                    raise RobotError('The skill executor does not answer.') from None
                yield None
                continue
            is_accepted = True
            if isinstance(news, Exception):
                raise news
            if news is not None:
                yield news
            if isinstance(news, PlanEnd):
                return

    def leave(self, run: PlanRun) -> None:
        """
        Cancel a plan, from any thread; without effect if it is over.

        Parameters
        ----------
        run
            The run that was passed to `execute`.

        """
        run.is_canceled = True
        executor = self._node.executor
        if executor is not None and not run.is_over:
            executor.create_task(self._cancel, run)

    async def stop(self) -> int:
        """
        Cancel all plans, whoever sent them, and return their number.

        Raises
        ------
        RobotError
            The executor is not running, or does not respond.

        """
        for run in list(self._runs.values()):
            run.is_canceled = True
        if not await self.thread.found(self._canceling.service_is_ready):
            raise RobotError('There is nothing to stop: the skill executor is not running.')
        answer = await self.thread.ask(self._canceling, CancelGoal.Request(), 'The skill executor')
        return len(answer.goals_canceling)

    def close(self) -> bool:
        """Cancel all plans of this server at shutdown; return whether there were any."""
        runs = [run for run in self._runs.values() if run.is_sent and not run.is_over]
        for run in runs:
            self._cancel(run)
        if self._guard is not None:
            self._guard.close()
        return bool(runs)

    def _send(self, plan: PlanMessage, run: PlanRun, tell: Callable[[Any], None]) -> None:
        """Send a plan unless it was canceled; runs in the thread of the node."""
        if run.is_canceled:
            tell(RobotError('It was stopped before it started.'))
            return
        run.is_sent = True

        def finish(news: Any) -> None:
            run.is_over = True
            self._runs.pop(bytes(run.goal_id.uuid), None)
            tell(news)

        def take_end(end: Any) -> None:
            finish(PlanEnd(end.result().status, end.result().result))

        def take_acceptance(sent: Any) -> None:
            handle = sent.result()
            if not handle.accepted:
                finish(RobotError('The skill executor rejected it.'))
                return
            tell(None)
            if run.is_canceled:
                self._cancel(run)
            handle.get_result_async().add_done_callback(take_end)

        sent = self._client.send_goal_async(
            ExecutePlan.Goal(plan=plan),
            feedback_callback=lambda message: tell(message.feedback),
            goal_uuid=run.goal_id,
        )
        sent.add_done_callback(take_acceptance)

    def _cancel(self, run: PlanRun) -> None:
        """Cancel a plan; runs in the thread of the node."""
        run.is_canceled = True
        goal = GoalInfo(goal_id=run.goal_id)
        self._canceling.call_async(CancelGoal.Request(goal_info=goal))


def _goal_id() -> Any:
    """Generate a unique goal id."""
    made = GoalInfo().goal_id
    made.uuid = list(uuid.uuid4().bytes)
    return made
