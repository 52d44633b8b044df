# SPDX-License-Identifier: Apache-2.0
"""An action client that has the Fibonacci sequence computed."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

from action_msgs.msg import GoalStatus
from action_tutorials_interfaces.action import Fibonacci
from rclpy.action import ActionClient
from rclpy.node import Node
from tf2_ros.executing import response_of, sleep
from tf2_ros.program import run_node

__all__ = ['FibonacciActionClient', 'main']

_LOOK_S = 0.1


class FibonacciActionClient(Node):
    """
    Sends goals to the action server `fibonacci`.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('fibonacci_action_client', **options)
        self._client = ActionClient(self, Fibonacci, 'fibonacci')

    async def send_goal(self, order: int = 10) -> None:
        """
        Send a goal once the server is there, and log feedback and result.

        Parameters
        ----------
        order
            The index of the last number of the sequence.

        """
        logger = self.get_logger()
        logger.info('Waiting for action server...')
        while not self._client.server_is_ready():
            await sleep(self, _LOOK_S)
        logger.info('Sending goal request...')
        request = Fibonacci.Goal(order=order)
        goal = await response_of(
            self, lambda: self._client.send_goal_async(request, self.feedback_callback)
        )
        if not goal.accepted:
            logger.info('Goal rejected :(')
            return
        logger.info('Goal accepted :)')
        response = await response_of(self, goal.get_result_async)
        if response.status == GoalStatus.STATUS_SUCCEEDED:
            logger.info(f'Goal succeeded! Result: {response.result.sequence}')
        else:
            logger.info(f'Goal failed with status: {response.status}')

    def feedback_callback(self, feedback: Any) -> None:
        """
        Log the sequence so far.

        Parameters
        ----------
        feedback
            The message of the server.

        """
        self.get_logger().info(f'Received feedback: {feedback.feedback.partial_sequence}')

    def destroy_node(self) -> None:
        """Destroy the action client, which the node does not do, and the node."""
        self._client.destroy()
        super().destroy_node()


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node until the goal has ended; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: FibonacciActionClient(), args, FibonacciActionClient.send_goal)


if __name__ == '__main__':
    sys.exit(main())
