# SPDX-License-Identifier: Apache-2.0
"""Action server for the goals of a controller."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any, Generic, TypeVar

from humanoid_common.executing import RESULT_TIMEOUT_S
from humanoid_control.controllers import CommandError, GoalController
from humanoid_control.hosting.reports import Refusals
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.action.server import ServerGoalHandle
from rclpy.node import Node
from rclpy.task import Future

FEEDBACK_RATE_HZ = 20.0

GoalT = TypeVar('GoalT')
ResultT = TypeVar('ResultT')


class GoalServer(ABC, Generic[GoalT, ResultT]):
    """
    Action server of one controller.

    A goal is checked, and rejected with a message in the log if it cannot be executed; a newer
    goal preempts the running one.

    Parameters
    ----------
    node, kind, name
        The node that offers the action, its type, and its name.
    controller
        Runs the goals.
    refusals
        Receives a message on each goal that is rejected.

    """

    def __init__(
        self,
        node: Node,
        kind: Any,
        name: str,
        controller: GoalController[GoalT, ResultT],
        refusals: Refusals,
    ) -> None:
        self._node, self._name = node, name
        self._goals, self._refusals = controller, refusals
        self._checked: GoalT | None = None
        self.current: ServerGoalHandle | None = None
        """The running goal."""
        self._ends: dict[bytes, Future] = {}
        self.time_s = 0.0
        """The robot's time."""
        self._server = ActionServer(
            node,
            kind,
            name,
            self._execute,
            goal_callback=self._check,
            handle_accepted_callback=self._start,
            cancel_callback=self._cancel,
            result_timeout=RESULT_TIMEOUT_S,
        )

    @abstractmethod
    def publish_feedback(self) -> None:
        """Publish the feedback of the running goal, if any."""

    @abstractmethod
    def checked(self, goal: Any) -> GoalT:
        """
        Check a goal, and convert it to what the controller accepts.

        Parameters
        ----------
        goal
            The goal of the action, as the client sent it.

        Returns
        -------
        GoalT
            The goal for `GoalController.accept`.

        Raises
        ------
        CommandError
            The goal cannot be executed; the message states why, and what to do.

        """

    @abstractmethod
    def finished(self, handle: ServerGoalHandle, end: ResultT) -> tuple[Any, str]:
        """
        Set the status of a goal that has ended, and build its result.

        Parameters
        ----------
        handle
            The goal; it is set to succeeded, canceled or aborted here.
        end
            How the controller ended it.

        Returns
        -------
        tuple
            The result message of the action, and the error message to log, '' without a failure.

        """

    def _check(self, goal: Any) -> GoalResponse:
        """Accept a goal that can be executed; log the reason why any other is rejected."""
        try:
            self._checked = self.checked(goal)
        except CommandError as error:
            self._refusals.add(f"Rejected a goal of '{self._name}'. {error}")
            return GoalResponse.REJECT
        return GoalResponse.ACCEPT

    def _start(self, handle: ServerGoalHandle) -> None:
        """Pass the goal that was just checked to the controller."""
        if self._checked is None:
            raise RuntimeError('A goal was accepted without a check.')
        end = self._ends[bytes(handle.goal_id.uuid)] = Future(executor=self._node.executor)
        self._goals.accept(self._checked, end.set_result)
        self._checked, self.current = None, handle
        handle.execute()

    async def _execute(self, handle: ServerGoalHandle) -> Any:
        """Wait for the end of a goal, and return its result."""
        goal_id = bytes(handle.goal_id.uuid)
        end: ResultT = await self._ends[goal_id]
        del self._ends[goal_id]
        if self.current is handle:
            self.current = None
        result, trouble = self.finished(handle, end)
        if trouble:
            self._node.get_logger().warning(f"Aborted a goal of '{self._name}'. {trouble}")
        return result

    def _cancel(self, handle: ServerGoalHandle) -> CancelResponse:
        """Cancel a goal for its client, unless it has ended meanwhile."""
        end = self._ends.get(bytes(handle.goal_id.uuid))
        if end is None or end.done():
            return CancelResponse.REJECT
        self._goals.cancel_goal()
        return CancelResponse.ACCEPT
