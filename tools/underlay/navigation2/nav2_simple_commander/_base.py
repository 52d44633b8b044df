# SPDX-License-Identifier: Apache-2.0
"""Base of the navigator: waiting for servers, and the current task."""

# ruff: noqa: N802
from __future__ import annotations

from enum import Enum
from typing import Any

from action_msgs.msg import GoalStatus
import rclpy
from rclpy.action import ActionClient
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

__all__ = ['Base', 'TaskResult']

_LOOK_S = 0.1


class TaskResult(Enum):
    """The outcome of a task."""

    UNKNOWN = 0
    SUCCEEDED = 1
    CANCELED = 2
    FAILED = 3


_RESULTS = {
    GoalStatus.STATUS_SUCCEEDED: TaskResult.SUCCEEDED,
    GoalStatus.STATUS_ABORTED: TaskResult.FAILED,
    GoalStatus.STATUS_CANCELED: TaskResult.CANCELED,
}


class Base(Node):
    """
    Node that runs one action task at a time.

    Parameters
    ----------
    node_name, namespace
        The name of the node.
    options
        Further keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, node_name: str, namespace: str, **options: Any) -> None:
        super().__init__(node_name, namespace=namespace, **options)
        self._spinner = SingleThreadedExecutor(context=self.context)
        self._action_clients: list[ActionClient] = []
        self.goal_handle: Any = None
        self.result_future: Any = None
        self.feedback: Any = None
        self.status: int | None = None
        self.last_action_error_code = 0
        self.last_action_error_msg = ''

    def destroyNode(self) -> None:
        """Destroy the node and its clients."""
        self.destroy_node()

    def destroy_node(self) -> None:
        """Destroy the node and its clients."""
        for client in self._action_clients:
            client.destroy()
        self._action_clients.clear()
        self._spinner.shutdown(0)
        super().destroy_node()

    def cancelTask(self) -> None:
        """Cancel the running task, and wait for the response of its server."""
        self.info('Canceling current task.')
        if self.result_future is not None and self.goal_handle is not None:
            self._wait(self.goal_handle.cancel_goal_async())

    def isTaskComplete(self, task: Any = None) -> bool:
        """
        Whether the task has ended; waits up to 0.1 s for that.

        Parameters
        ----------
        task
            No effect: there is only one task.

        """
        if self.result_future is None:
            return True
        self._wait(self.result_future, _LOOK_S)
        answer = self.result_future.result() if self.result_future.done() else None
        if answer is None:
            return False
        self.status = answer.status
        if self.status != GoalStatus.STATUS_SUCCEEDED:
            self._keep_error(answer.result)
        return True

    def getFeedback(self, task: Any = None) -> Any:
        """
        Return the newest feedback of the task; None before the first.

        Parameters
        ----------
        task
            No effect: there is only one task.

        """
        return self.feedback

    def getResult(self) -> TaskResult:
        """Return the outcome of the task."""
        return _RESULTS.get(self.status, TaskResult.UNKNOWN)

    def getTaskError(self) -> tuple[int, str]:
        """Return the error code and the message of the last task; (0, '') without an error."""
        return self.last_action_error_code, self.last_action_error_msg

    def setTaskError(self, error_code: int, error_msg: str) -> None:
        """
        Set the return value of `getTaskError`.

        Parameters
        ----------
        error_code, error_msg
            As in the result of the action; 0 and '' without an error.

        """
        self.last_action_error_code, self.last_action_error_msg = error_code, error_msg

    def clearTaskError(self) -> None:
        """Clear the error of the last task."""
        self.setTaskError(0, '')

    def _keep_error(self, result: Any) -> None:
        code, message = getattr(result, 'error_code', 0), getattr(result, 'error_msg', '')
        self.setTaskError(code, message)
        self.debug(f'Task with failed status code: {self.status} ({code}: {message})')

    def _action(self, kind: Any, name: str) -> ActionClient:
        client = ActionClient(self, kind, name)
        self._action_clients.append(client)
        return client

    def _wait(self, future: Any, timeout_s: float | None = None) -> None:
        """Spin until a future is done."""
        rclpy.spin_until_future_complete(self, future, self._spinner, timeout_s)

    def _wait_for_server(self, client: ActionClient, name: str) -> None:
        self.debug(f"Waiting for '{name}' action server")
        while not client.wait_for_server(timeout_sec=1.0):
            self.info(f"'{name}' action server not available, waiting...")

    def _send(self, client: ActionClient, goal: Any) -> Any:
        """Send a goal; return its handle, or None if it was rejected."""
        future = client.send_goal_async(goal, self._feedbackCallback)
        self._wait(future)
        handle = future.result()
        return handle if handle is not None and handle.accepted else None

    def _start(self, client: ActionClient, name: str, goal: Any, what: str) -> bool:
        """Start a task; return whether its server has accepted the goal."""
        self.clearTaskError()
        self._wait_for_server(client, name)
        self.info(f'{what}...')
        self.feedback, self.status, self.result_future = None, None, None
        self.goal_handle = self._send(client, goal)
        if self.goal_handle is None:
            message = f"The server of '{name}' rejected the goal. Is its node active?"
            self.setTaskError(0, message)
            self.status = GoalStatus.STATUS_ABORTED
            self.error(message)
            return False
        self.result_future = self.goal_handle.get_result_async()
        return True

    def _ask_action(self, client: ActionClient, name: str, goal: Any) -> Any:
        """Run a short action; return its result, or None if it has failed."""
        self.clearTaskError()
        self._wait_for_server(client, name)
        handle = self._send(client, goal)
        if handle is None:
            self.setTaskError(0, f"The server of '{name}' rejected the goal.")
            self.error(self.last_action_error_msg)
            return None
        ending = handle.get_result_async()
        self._wait(ending)
        answer = ending.result()
        self.status = answer.status
        if self.status == GoalStatus.STATUS_SUCCEEDED:
            return answer.result
        self._keep_error(answer.result)
        self.warn(f"'{name}' failed ({self.status}): {self.last_action_error_msg}")
        return None

    def _ask_service(self, client: Any, request: Any) -> Any:
        """Call a service; wait for its response."""
        while not client.wait_for_service(timeout_sec=1.0):
            self.info(f"'{client.srv_name}' service not available, waiting...")
        future = client.call_async(request)
        self._wait(future)
        return future.result()

    def _feedbackCallback(self, msg: Any) -> None:
        self.debug('Received action feedback message')
        self.feedback = msg.feedback

    def info(self, msg: str) -> None:
        """
        Log a message at level INFO.

        Parameters
        ----------
        msg
            The text.

        """
        self.get_logger().info(msg)

    def warn(self, msg: str) -> None:
        """
        Log a message at level WARN.

        Parameters
        ----------
        msg
            The text.

        """
        self.get_logger().warning(msg)

    def error(self, msg: str) -> None:
        """
        Log a message at level ERROR.

        Parameters
        ----------
        msg
            The text.

        """
        self.get_logger().error(msg)

    def debug(self, msg: str) -> None:
        """
        Log a message at level DEBUG.

        Parameters
        ----------
        msg
            The text.

        """
        self.get_logger().debug(msg)
