# SPDX-License-Identifier: Apache-2.0
"""Action server that executes one goal at a time, in a coroutine."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
import traceback
from typing import Any, TYPE_CHECKING

from action_msgs.msg import GoalStatus
from nav2_util.errors import ActionAborted
import rclpy.action
from rclpy.action import CancelResponse, GoalResponse
from rclpy.action.server import ServerGoalHandle
from rclpy.task import Future
from tf2_ros.executing import RESULT_MARGIN_S

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['ActionServer', 'GoalCanceled']

_REPLACED = 'A newer goal took its place.'


class GoalCanceled(Exception):
    """The client has canceled the goal."""


class _Server(rclpy.action.ActionServer):
    """Action server of rclpy that sends no results once its handle has been destroyed."""

    is_destroyed = False

    def destroy(self) -> None:
        """Destroy the handle, through which clients are answered."""
        self.is_destroyed = True
        super().destroy()

    def _send_result_response(self, request_header: Any, future: Any) -> None:
        if not self.is_destroyed:
            super()._send_result_response(request_header, future)


class ActionServer:
    """
    Action server that executes one goal at a time; a newer goal preempts the running one.

    Parameters
    ----------
    node
        The node that offers the action.
    kind, name
        The type of the action and its name.
    work
        A coroutine function that executes a goal, and returns on success. It fills in `result`,
        calls `check` at least every 50 ms, and takes over a newer goal with `accept_pending` when
        `is_preempt_requested`, or leaves through `check`, which then ends the old goal.
    takes_over
        Whether `work` takes over newer goals; otherwise `check` ends the old one, and `work` is
        called again.
    check_goal
        Called with a goal before it is accepted; a non-empty return value is the reason for its
        rejection.
    result_timeout_s
        The time for which the result of a goal is kept for later requests; forever if negative.

    """

    def __init__(
        self,
        node: Node,
        kind: Any,
        name: str,
        work: Callable[[Any], Awaitable[None]],
        *,
        takes_over: bool = False,
        check_goal: Callable[[Any], str | None] | None = None,
        result_timeout_s: float = 10.0,
    ) -> None:
        self.name = name
        self._node, self._kind = node, kind
        self.set_work(work, takes_over=takes_over, check_goal=check_goal)
        self._current: ServerGoalHandle | None = None
        self._pending: ServerGoalHandle | None = None
        self._ends: dict[bytes, Future[Any]] = {}
        self._is_active = self._has_to_end = False
        self.result: Any = kind.Result()
        """The result of the running goal, for `work` to fill in; error codes are added."""
        self._server = _Server(
            node,
            kind,
            name,
            self._finish,
            goal_callback=self._consider,
            handle_accepted_callback=self._accept,
            cancel_callback=lambda _: CancelResponse.ACCEPT,
            result_timeout=result_timeout_s + RESULT_MARGIN_S,
        )

    def set_work(
        self,
        work: Callable[[Any], Awaitable[None]],
        *,
        takes_over: bool = False,
        check_goal: Callable[[Any], str | None] | None = None,
    ) -> None:
        """
        Set the execution function, from the next goal on.

        Parameters
        ----------
        work, takes_over, check_goal
            As for the class.

        """
        self._work, self._takes_over, self._check_goal = work, takes_over, check_goal

    def activate(self) -> None:
        """Accept goals from now on."""
        self._is_active = True

    def deactivate(self) -> None:
        """Reject goals from now on, and end the running one at its next `check`."""
        self._is_active, self._has_to_end = False, self._current is not None
        self.reject_pending(self._unknown(), self._deactivated)

    def destroy(self) -> None:
        """Destroy the action server; clients receive no result of a goal that is still active."""
        self._is_active, self._has_to_end, self._pending = False, True, None
        self._server.destroy()

    @property
    def is_running(self) -> bool:
        """Whether a goal is being executed."""
        return self._current is not None

    @property
    def is_busy(self) -> bool:
        """Whether there are goals whose results were not sent to their clients yet."""
        return bool(self._ends)

    @property
    def is_cancel_requested(self) -> bool:
        """Whether cancellation of the running goal is requested, and no newer goal is pending."""
        return self._current is not None and self._current.is_cancel_requested

    @property
    def is_preempt_requested(self) -> bool:
        """Whether a newer goal is pending."""
        return self._pending is not None

    def pending_goal(self) -> Any:
        """Return the pending newer goal without accepting it; None if there is none."""
        return None if self._pending is None else self._pending.request

    def check(self) -> None:
        """
        Raise an exception to leave `work` if the goal has to end now.

        Raises
        ------
        GoalCanceled
            The client has canceled it.
        ActionAborted
            The node is no longer active, or a newer goal is pending that `work` does not take
            over.

        """
        if self._has_to_end:
            raise ActionAborted(self._unknown(), self._deactivated)
        if self._pending is not None and not self._takes_over:
            raise ActionAborted(self._unknown(), _REPLACED)
        if self.is_cancel_requested and self._pending is None:
            raise GoalCanceled

    def accept_pending(self) -> Any:
        """End the running goal as preempted; return the newer one."""
        handle, self._pending = self._pending, None
        if handle is None:
            raise RuntimeError('There is no newer goal.')
        self._end(GoalStatus.STATUS_ABORTED, self._unknown(), _REPLACED)
        self._current, self.result = handle, self._kind.Result()
        return handle.request

    def reject_pending(self, code: int, message: str) -> None:
        """
        Abort the pending newer goal, because it cannot be reached; the old one continues.

        Parameters
        ----------
        code, message
            The `error_code` and the `error_msg`, a full sentence, of its result.

        """
        handle, self._pending = self._pending, None
        if handle is not None:
            self._settle(handle, GoalStatus.STATUS_ABORTED, self._kind.Result(), code, message)

    def publish_feedback(self, feedback: Any) -> None:
        """
        Publish feedback on the running goal, if there is one.

        Parameters
        ----------
        feedback
            The feedback message of the action.

        """
        if self._current is not None and self._current.is_active:
            self._current.publish_feedback(feedback)

    @property
    def _deactivated(self) -> str:
        return f"'{self.name}' was deactivated."

    def _unknown(self) -> int:
        return int(getattr(self._kind.Result, 'UNKNOWN', 1))

    def _consider(self, goal: Any) -> GoalResponse:
        reason = None if self._is_active else 'the node is not active'
        if reason is None and self._check_goal is not None:
            reason = self._check_goal(goal)
        if reason is None:
            return GoalResponse.ACCEPT
        self._node.get_logger().warning(f"Rejected a goal of '{self.name}': {reason}.")
        return GoalResponse.REJECT

    def _accept(self, handle: ServerGoalHandle) -> None:
        self._ends[bytes(handle.goal_id.uuid)] = Future(executor=self._node.executor)
        handle.execute()
        if self._pending is not None:
            self.reject_pending(self._unknown(), _REPLACED)
        self._pending = handle
        if self._current is None and self._node.executor is not None:
            self._node.executor.create_task(self._run)

    async def _run(self) -> None:
        """Execute goals until none is pending."""
        while self._pending is not None and self._current is None:
            self._current, self._pending = self._pending, None
            self._has_to_end = False
            self.result = self._kind.Result()
            status, code, message = GoalStatus.STATUS_SUCCEEDED, 0, ''
            try:
                await self._work(self._current.request)
            except GoalCanceled:
                status = GoalStatus.STATUS_CANCELED
            except ActionAborted as error:
                status, code, message = GoalStatus.STATUS_ABORTED, error.code, str(error)
            except Exception as error:
                self._node.get_logger().error(traceback.format_exc())
                status, code = GoalStatus.STATUS_ABORTED, self._unknown()
                message = f"'{self.name}' failed: {type(error).__name__}: {error}"
            self._end(status, code, message)

    def _end(self, status: int, code: int, message: str) -> None:
        handle, self._current = self._current, None
        if handle is not None:
            self._settle(handle, status, self.result, code, message)

    def _settle(
        self, handle: ServerGoalHandle, status: int, result: Any, code: int, message: str
    ) -> None:
        if code and hasattr(result, 'error_code'):
            result.error_code, result.error_msg = code, message
        # Paths are replaced once a second: not worth a log message.
        if status == GoalStatus.STATUS_ABORTED and message != _REPLACED:
            self._node.get_logger().warning(f"Aborted a goal of '{self.name}'. {message}")
        self._ends[bytes(handle.goal_id.uuid)].set_result((status, result))

    async def _finish(self, handle: ServerGoalHandle) -> Any:
        """End a goal, and send its result to the client."""
        goal_id = bytes(handle.goal_id.uuid)  # it may have ended before this starts
        status, result = await self._ends[goal_id]
        del self._ends[goal_id]
        if status == GoalStatus.STATUS_SUCCEEDED:
            handle.succeed()
        elif status == GoalStatus.STATUS_CANCELED and handle.is_cancel_requested:
            handle.canceled()
        else:
            handle.abort()
        return result
