# SPDX-License-Identifier: Apache-2.0
"""Actions that run one goal at a time, because they move the same joints."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Iterator
from contextlib import contextmanager
import traceback
from typing import Any

from humanoid_common.client_goals import cancel_goal, ResultRequest
from humanoid_common.executing import RESULT_TIMEOUT_S
from rclpy.action import ActionClient, ActionServer, CancelResponse, GoalResponse
from rclpy.action.server import ServerGoalHandle
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.task import Future

__all__ = ['GoalAborted', 'GoalCanceled', 'RunningGoal', 'SingleGoal']

_TICK_HZ = 20.0
_PATIENCE_S = 5.0
"""Maximum wait for a condition that a goal needs."""


class GoalCanceled(Exception):
    """The client has canceled the goal."""


class GoalAborted(Exception):
    """A goal cannot be reached; `name` is an error code of its result, `text` the reason."""

    def __init__(self, name: str, text: str) -> None:
        super().__init__(text)
        self.name = name


class RunningGoal:
    """
    A running goal: its request, its result, and whether it may continue.

    Parameters
    ----------
    owner
        Runs the goals; knows the newest one and the reason why the robot may not move.
    handle
        The server goal handle.
    result
        The result message, which the work of the goal fills in.

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
        Raise an exception if the goal is to end now.

        Raises
        ------
        GoalCanceled
            The client has requested it.
        GoalAborted
            A newer goal has come, or the robot may not move.

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
        """Ignore a cancel request within the block, so that the goal can clean up."""
        self._is_ending = True
        try:
            yield
        finally:
            self._is_ending = False

    async def tick(self) -> None:
        """Wait for a period of a steady clock, then `check`."""
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
        Delegate a part of this goal to another action; return its response with status and result.

        If this goal ends meanwhile, the delegated goal is canceled.

        Parameters
        ----------
        client, wanted
            The client of the other action, and the goal that it is given.
        action, code
            Name of the action, for messages, and of the error code if it fails.
        check
            Called in every period; raises an exception to end the goal.

        Raises
        ------
        GoalAborted
            The action is not available, does not answer, rejects the goal, or vanishes while it
            runs.

        """
        if not await self.comes(client.server_is_ready):
            raise GoalAborted(code, f"No action server for '{action}'. Start its node.")
        sent = client.send_goal_async(wanted)
        try:
            if not await self.comes(sent.done):
                raise GoalAborted(code, f"'{action}' does not answer.")
            handle = sent.result()
            if not handle.accepted:
                raise GoalAborted(code, f"'{action}' rejected a goal. Its log says why.")
            end = ResultRequest(handle)
            while not end.done():
                await self.tick()
                check()
                if not client.server_is_ready() and not await self.comes(end.done):
                    raise GoalAborted(code, f"The server of '{action}' exited during a goal.")
        except BaseException:
            cancel_goal(sent)
            raise
        return end.result()


Work = Callable[[RunningGoal], Awaitable[None]]


class SingleGoal:
    """
    Runs the goals of several actions, one at a time; the newest preempts the others.

    Parameters
    ----------
    node
        The node that offers the actions.
    inhibition
        Returns the reason why the robot may not move; empty if it may.

    """

    def __init__(self, node: Node, inhibition: Callable[[], str]) -> None:
        self._node, self.inhibition = node, inhibition
        self.newest: ServerGoalHandle | None = None
        """The goal that was accepted last."""
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
            Coroutine function that executes a goal; it awaits `RunningGoal.tick` repeatedly.
        check
            Returns the reason why a goal is rejected; empty if it is not.

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
                result_timeout=RESULT_TIMEOUT_S,
            )
        )

    async def tick(self) -> None:
        """Wait for a period of a steady clock, or until woken."""
        if self._timer is None:
            self._timer = self._node.create_timer(1.0 / _TICK_HZ, self._fire, clock=self._clock)
        elif self._timer.is_canceled():
            self._timer.reset()
        done: Future[None] = Future(executor=self._node.executor)
        self._waiting.append(done)
        await done

    def _wake(self) -> None:
        """End the wait of the running work at once, so that it checks whether it may continue."""
        self._node.executor.create_task(self._fire)

    def _fire(self) -> None:
        waiting, self._waiting = self._waiting, []
        for each in waiting:
            each.set_result(None)
        if not waiting and self._running is None and self._timer is not None:
            self._timer.cancel()

    async def _execute(self, kind: Any, name: str, work: Work, handle: ServerGoalHandle) -> Any:
        """Wait for the previous goal, run this one, and return its result."""
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
