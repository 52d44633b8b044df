# SPDX-License-Identifier: Apache-2.0
"""Actions of which one goal runs at a time, because they move the same joints."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Iterator
from contextlib import contextmanager
import traceback
from typing import Any

from humanoid_common.client_goals import cancel_goal, GoalResult
from rclpy.action import ActionClient, ActionServer, CancelResponse, GoalResponse
from rclpy.action.server import ServerGoalHandle
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.task import Future

__all__ = ['GoalAborted', 'GoalCanceled', 'RunningGoal', 'SingleGoal']

_TICK_HZ = 20.0
_PATIENCE_S = 5.0
"""How long what a goal needs may take to come."""


class GoalCanceled(Exception):
    """The client has canceled the goal."""


class GoalAborted(Exception):
    """A goal cannot be reached; `name` is that of a code of its result, the text says why."""

    def __init__(self, name: str, text: str) -> None:
        super().__init__(text)
        self.name = name


class RunningGoal:
    """
    A goal that is being worked on: its request, its result, and whether it may go on.

    Parameters
    ----------
    owner
        Runs the goals, and knows the newest one and why the robot may not move.
    handle
        The goal as the action server has it.
    result
        The result message, which the work fills in.

    Attributes
    ----------
    request
        The goal message that the client sent.

    """

    def __init__(self, owner: SingleGoal, handle: ServerGoalHandle, result: Any) -> None:
        self._owner, self._handle = owner, handle
        self.request, self.result = handle.request, result
        self._is_ending = False

    def publish_feedback(self, feedback: Any) -> None:
        """
        Publish feedback to the client, unless the goal has ended.

        Parameters
        ----------
        feedback
            The feedback message of the action.

        """
        if self._handle.is_active:
            self._handle.publish_feedback(feedback)

    def check(self) -> None:
        """
        Leave the work if the goal is to end now.

        Raises
        ------
        GoalCanceled
            The client wants that.
        GoalAborted
            A newer goal is there, or the robot may not move.

        """
        if self._handle.is_cancel_requested and not self._is_ending:
            raise GoalCanceled
        if self._owner.newest is not self._handle:
            raise GoalAborted('PREEMPTED', 'A newer goal took its place.')
        reason = self._owner.inhibition()
        if reason:
            raise GoalAborted('INHIBITED', reason)

    @contextmanager
    def ending(self) -> Iterator[None]:
        """Let a goal that is canceled go on meanwhile, to leave things in order."""
        self._is_ending = True
        try:
            yield
        finally:
            self._is_ending = False

    async def tick(self) -> None:
        """Wait a moment by a clock that nobody stops, and check."""
        await self._owner.tick()
        self.check()

    async def comes(self, condition: Callable[[], bool]) -> bool:
        """
        Wait until a condition holds, for 5 s at most.

        Parameters
        ----------
        condition
            Evaluated 20 times a second.

        Returns
        -------
        bool
            Whether the condition holds at the end.

        Raises
        ------
        GoalCanceled, GoalAborted
            As for `check`, which is called meanwhile.

        """
        for _ in range(round(_PATIENCE_S * _TICK_HZ)):
            if condition():
                break
            await self.tick()
        return condition()

    async def delegate(
        self,
        client: ActionClient,
        wanted: Any,
        action: str,
        code: str,
        check: Callable[[], None] = lambda: None,
    ) -> Any:
        """
        Have another action do a part of this goal; return its answer, with status and result.

        If this goal ends meanwhile, that part is canceled.

        Parameters
        ----------
        client, wanted
            The client of the other action, and the goal that it is given.
        action, code
            The name of the action, for sentences, and of the code if it is of no use.
        check
            Called all the time; raises what ends the goal.

        Raises
        ------
        GoalAborted
            The action is not there, does not answer, rejects the goal, or ends in its middle.

        """
        if not await self.comes(client.server_is_ready):
            raise GoalAborted(code, f"The action '{action}' is not there. Start what offers it.")
        sent = client.send_goal_async(wanted)
        try:
            if not await self.comes(sent.done):
                raise GoalAborted(code, f"'{action}' does not answer.")
            handle = sent.result()
            if not handle.accepted:
                raise GoalAborted(code, f"'{action}' rejected a goal: its log says why.")
            end = GoalResult(handle)
            while not end.done():
                await self.tick()
                check()
                if not client.server_is_ready() and not await self.comes(end.done):
                    raise GoalAborted(code, f"'{action}' ended in the middle of its work.")
        except BaseException:
            cancel_goal(sent)
            raise
        return end.result()


Work = Callable[[RunningGoal], Awaitable[None]]


class SingleGoal:
    """
    Works on the goals of some actions, one at a time; the newest takes the place of others.

    Parameters
    ----------
    node
        The node that offers the actions.
    inhibition
        Returns why the robot may not move; nothing if it may.

    """

    def __init__(self, node: Node, inhibition: Callable[[], str]) -> None:
        self._node, self.inhibition = node, inhibition
        self.newest: ServerGoalHandle | None = None
        """The goal that came last."""
        self._running: Future[None] | None = None
        self._servers: list[ActionServer] = []
        self._clock = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer: Any = None
        self._waiting: list[Future[None]] = []

    def offer(
        self, kind: Any, name: str, work: Work, check: Callable[[Any], str] = lambda _: ''
    ) -> None:
        """
        Offer an action.

        Parameters
        ----------
        kind, name
            Its type and name.
        work
            A coroutine function that reaches a goal; it awaits `RunningGoal.tick` again and again.
        check
            Returns why a goal is rejected; nothing if it is not.

        """

        def consider(request: Any) -> GoalResponse:
            reason = check(request)
            if reason:
                self._node.get_logger().warning(f"Rejected a goal of '{name}'. {reason}")
                return GoalResponse.REJECT
            return GoalResponse.ACCEPT

        def accept(handle: ServerGoalHandle) -> None:
            self.newest = handle
            handle.execute()
            self._wake()

        def cancel(_: ServerGoalHandle) -> CancelResponse:
            self._wake()
            return CancelResponse.ACCEPT

        async def execute(handle: ServerGoalHandle) -> Any:
            return await self._execute(kind, name, work, handle)

        self._servers.append(
            ActionServer(
                self._node,
                kind,
                name,
                execute,
                goal_callback=consider,
                handle_accepted_callback=accept,
                cancel_callback=cancel,
            )
        )

    async def tick(self) -> None:
        """Wait a moment, by a clock that nobody stops."""
        if self._timer is None:
            self._timer = self._node.create_timer(1.0 / _TICK_HZ, self._fire, clock=self._clock)
        elif self._timer.is_canceled():
            self._timer.reset()
        done: Future[None] = Future(executor=self._node.executor)
        self._waiting.append(done)
        await done

    def _wake(self) -> None:
        """End the moment for which the work waits: it is to look whether it may go on."""
        self._node.executor.create_task(self._fire)

    def _fire(self) -> None:
        waiting, self._waiting = self._waiting, []
        for each in waiting:
            each.set_result(None)
        if not waiting and self._running is None and self._timer is not None:
            self._timer.cancel()

    async def _execute(self, kind: Any, name: str, work: Work, handle: ServerGoalHandle) -> Any:
        """Wait for the goal before, work on this one, and say how it ended."""
        while self._running is not None:
            await self._running
        self._running = Future(executor=self._node.executor)
        goal = RunningGoal(self, handle, kind.Result())
        try:
            goal.check()
            await work(goal)
            handle.succeed()
        except GoalCanceled:
            handle.canceled()
        except GoalAborted as error:
            self._settle(goal.result, name, error)
            handle.abort()
        except Exception as error:
            self._node.get_logger().error(traceback.format_exc())
            text = f'{type(error).__name__}: {error}'
            self._settle(goal.result, name, GoalAborted('UNKNOWN', text))
            handle.abort()
        finally:
            running, self._running = self._running, None
            running.set_result(None)
        return goal.result

    def _settle(self, result: Any, name: str, error: GoalAborted) -> None:
        if error.name != 'PREEMPTED':
            self._node.get_logger().warning(f"Aborted a goal of '{name}'. {error}")
        if hasattr(result, 'error_code'):
            result.error_code = getattr(type(result), error.name, 99)
            result.error_msg = str(error)
