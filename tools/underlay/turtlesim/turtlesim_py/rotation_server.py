# SPDX-License-Identifier: Apache-2.0
"""The action that turns a turtle to a heading."""

from __future__ import annotations

from collections.abc import Callable
import math
import time
from typing import Any, TYPE_CHECKING

from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.action.server import ServerGoalHandle
from rclpy.task import Future
from tf2_ros.executing import RESULT_MARGIN_S
from turtlesim.action import RotateAbsolute
from turtlesim_py.turtle import Turtle, wrapped

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['RotationServer']

RESULT_TIMEOUT_S = 10.0
LAST_RESULT_S = 1.0
"""For how long those who sent a goal may ask for its result after the turtle has gone."""
End = Callable[[ServerGoalHandle], None]


class RotationServer:
    """
    Action server that turns a turtle; a new goal aborts the one before.

    Parameters
    ----------
    node, name
        The node that offers the action, and its name.
    turtle
        The turtle.

    """

    def __init__(self, node: Node, name: str, turtle: Turtle) -> None:
        self._node = node
        self._name = name
        self._turtle = turtle
        self._start = turtle.theta
        self._is_closed = False
        self._until_s = 0.0
        self._current: ServerGoalHandle | None = None
        self._ends: dict[bytes, Future] = {}
        self._server = ActionServer(
            node,
            RotateAbsolute,
            name,
            self._finish,
            goal_callback=self._consider,
            handle_accepted_callback=self._accept,
            cancel_callback=lambda goal: CancelResponse.ACCEPT,
            result_timeout=RESULT_TIMEOUT_S + RESULT_MARGIN_S,
        )

    @property
    def is_busy(self) -> bool:
        """Whether there are goals whose results may not have been sent yet."""
        return bool(self._ends) or time.monotonic() < self._until_s

    def update(self) -> None:
        """Publish feedback on the goal, or end it if the turtle is there or it is canceled."""
        if self._current is None:
            return
        log = self._node.get_logger()
        if self._current.is_cancel_requested:
            self._turtle.stop()
            self._end(ServerGoalHandle.canceled)
            log.info('Rotation goal canceled')
            return
        self._current.publish_feedback(RotateAbsolute.Feedback(remaining=self._turtle.remaining))
        if self._turtle.goal is None:
            self._end(ServerGoalHandle.succeed)
            log.info('Rotation goal completed successfully')

    def replace(self, turtle: Turtle) -> None:
        """
        Abort the goal, and turn another turtle from now on.

        Parameters
        ----------
        turtle
            The other turtle.

        """
        self.abort()
        self._turtle = turtle

    def abort(self) -> None:
        """Abort the goal, if there is one."""
        if self._current is not None:
            self._turtle.stop()
            self._end(ServerGoalHandle.abort)

    def close(self) -> None:
        """Abort the goal, and reject others; the results are still sent."""
        self._is_closed = True
        if self._ends:
            self._until_s = time.monotonic() + LAST_RESULT_S
        self.abort()

    def destroy(self) -> None:
        """Destroy the action server; clients receive no results that were not sent yet."""
        self._server.destroy()

    def _consider(self, goal: Any) -> GoalResponse:
        if self._is_closed:
            return GoalResponse.REJECT
        if math.isfinite(goal.theta):
            return GoalResponse.ACCEPT
        self._node.get_logger().error(
            f"Rejected a goal of '{self._name}': {goal.theta} is not a heading"
        )
        return GoalResponse.REJECT

    def _accept(self, handle: ServerGoalHandle) -> None:
        if self._current is not None:
            self._node.get_logger().warning(
                'Rotation goal received before a previous goal finished. Aborting previous goal'
            )
            self.abort()
        self._ends[bytes(handle.goal_id.uuid)] = Future(executor=self._node.executor)
        self._current, self._start = handle, self._turtle.theta
        self._turtle.turn_to(handle.request.theta)
        handle.execute()

    def _end(self, end: End) -> None:
        handle, self._current = self._current, None
        if handle is not None:
            delta = wrapped(self._start - self._turtle.theta)
            result = RotateAbsolute.Result(delta=delta)
            self._ends[bytes(handle.goal_id.uuid)].set_result((end, result))

    async def _finish(self, handle: ServerGoalHandle) -> Any:
        """Wait for the end of a goal, and return its result."""
        goal_id = bytes(handle.goal_id.uuid)
        end, result = await self._ends[goal_id]
        end(handle)
        del self._ends[goal_id]
        return result
