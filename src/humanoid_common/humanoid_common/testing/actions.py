# SPDX-License-Identifier: Apache-2.0
"""Action client for tests."""

from __future__ import annotations

from typing import Any, NamedTuple

from humanoid_common.testing.ros import RosSandbox
from rclpy.action import ActionClient
from rclpy.task import Future

PATIENCE_S = 100.0
"""How long an answer may take on a busy computer."""


class End(NamedTuple):
    """End of a goal: its status, one of `action_msgs/msg/GoalStatus`, and its result."""

    status: int
    result: Any


class ActionCaller:
    """
    Action client, whose constructor waits for the action server.

    Parameters
    ----------
    ros
        The sandbox of the nodes of the test.
    kind, name
        The type and the name of the action.

    Attributes
    ----------
    feedback
        Feedback of the goals that was received so far; a test may clear it.

    """

    def __init__(self, ros: RosSandbox, kind: Any, name: str) -> None:
        self.kind, self._ros, self._name = kind, ros, name
        self.feedback: list[Any] = []
        self._client = ActionClient(ros.observer(), kind, name)
        ros.wait_until(self._client.server_is_ready, PATIENCE_S, name)

    def send(self, goal: Any = None, **fields: Any) -> Any:
        """
        Send a goal, and wait until it is accepted or rejected.

        Parameters
        ----------
        goal
            The goal; None builds one from its fields.
        **fields
            Fields of the goal, if it is not given as a whole.

        Returns
        -------
        ClientGoalHandle
            The handle of the goal; its `accepted` reports whether it was accepted.

        """
        future = self._client.send_goal_async(
            self.kind.Goal(**fields) if goal is None else goal,
            lambda message: self.feedback.append(message.feedback),
        )
        return self._waited(future, PATIENCE_S)

    def end_of(self, handle: Any, patience_s: float = PATIENCE_S) -> End:
        """
        Wait for the end of a goal that was accepted.

        Parameters
        ----------
        handle
            What `send` returned.
        patience_s
            Real time to wait before the test fails.

        Returns
        -------
        End
            Its status and its result.

        """
        assert handle.accepted
        answer = self._waited(handle.get_result_async(), patience_s)
        return End(answer.status, answer.result)

    def cancel(self, handle: Any) -> Any:
        """
        Cancel a goal, and wait for the answer.

        Parameters
        ----------
        handle
            What `send` returned.

        Returns
        -------
        CancelGoal.Response
            The answer of the action server.

        """
        return self._waited(handle.cancel_goal_async(), PATIENCE_S)

    def close(self) -> None:
        """Destroy the client."""
        self._client.destroy()

    def _waited(self, future: Future[Any], patience_s: float) -> Any:
        self._ros.wait_until(future.done, patience_s, f'a response from {self._name}')
        return future.result()
