# SPDX-License-Identifier: Apache-2.0
"""An action client that has the Fibonacci sequence computed."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

from action_msgs.msg import GoalStatus
from example_interfaces.action import Fibonacci
from rclpy.action import ActionClient
from rclpy.node import Node
from tf2_ros.executing import response_of, sleep
from tf2_ros.program import run_node

__all__ = ['MinimalActionClient', 'main']

ORDER = 10
LOOK_S = 0.1


class MinimalActionClient(Node):
    """
    Sends goals to the action server `fibonacci`.

    Parameters
    ----------
    name
        The name of the node.
    options
        Further keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, name: str = 'minimal_action_client', **options: Any) -> None:
        super().__init__(name, **options)
        self._action_client = ActionClient(self, Fibonacci, 'fibonacci')

    async def send_goal(self) -> None:
        """Send a goal, and log the feedback and how it ends."""
        goal = await self.accepted_goal()
        if goal is not None:
            await self.log_result(goal)

    async def accepted_goal(self, order: int = ORDER) -> Any:
        """
        Send a goal once the server is there.

        Parameters
        ----------
        order
            The index of the last number of the sequence.

        Returns
        -------
        Any
            The handle of the goal, or None if it was rejected.

        """
        logger = self.get_logger()
        logger.info('Waiting for action server...')
        while not self._action_client.server_is_ready():
            await sleep(self, LOOK_S)
        logger.info('Sending goal request...')
        request = Fibonacci.Goal(order=order)
        goal = await response_of(
            self, lambda: self._action_client.send_goal_async(request, self.feedback_callback)
        )
        logger.info('Goal accepted :)' if goal.accepted else 'Goal rejected :(')
        return goal if goal.accepted else None

    async def log_result(self, goal: Any) -> None:
        """
        Wait for the end of a goal, and log it.

        Parameters
        ----------
        goal
            The handle of the goal.

        """
        response = await response_of(self, goal.get_result_async)
        if response.status == GoalStatus.STATUS_SUCCEEDED:
            self.get_logger().info(f'Goal succeeded! Result: {response.result.sequence}')
        else:
            self.get_logger().info(f'Goal failed with status: {response.status}')

    def feedback_callback(self, feedback: Any) -> None:
        """
        Log the sequence so far.

        Parameters
        ----------
        feedback
            The message of the server.

        """
        self.get_logger().info(f'Received feedback: {feedback.feedback.sequence}')

    def destroy_node(self) -> None:
        """Destroy the action client, which the node does not do, and the node."""
        self._action_client.destroy()
        super().destroy_node()


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: MinimalActionClient(), args, MinimalActionClient.send_goal)


if __name__ == '__main__':
    sys.exit(main())
