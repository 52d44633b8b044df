# SPDX-License-Identifier: Apache-2.0
"""An action server that computes the Fibonacci sequence, and goals that can be canceled."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

from example_interfaces.action import Fibonacci
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.node import Node
from tf2_ros.executing import sleep
from tf2_ros.program import run_node

__all__ = ['MinimalActionServer', 'main']

HIGHEST_ORDER = 46
"""From the next order on, the last number does not fit into the 32 bits of the message."""
PERIOD_S = 1.0


class MinimalActionServer(Node):
    """
    Offers the action `fibonacci`, which adds a number to the sequence once per second.

    Parameters
    ----------
    period_s
        The time between two numbers, in s.
    options
        Further keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, period_s: float = PERIOD_S, **options: Any) -> None:
        super().__init__('minimal_action_server', **options)
        self._period_s = period_s
        self._action_server = ActionServer(
            self,
            Fibonacci,
            'fibonacci',
            self.execute_callback,
            goal_callback=self.goal_callback,
            handle_accepted_callback=self.handle_accepted_callback,
            cancel_callback=self.cancel_callback,
        )

    def goal_callback(self, goal_request: Fibonacci.Goal) -> GoalResponse:
        """
        Accept a goal, unless its numbers do not fit into the message.

        Parameters
        ----------
        goal_request
            The goal.

        """
        self.get_logger().info('Received goal request')
        if goal_request.order <= HIGHEST_ORDER:
            return GoalResponse.ACCEPT
        self.get_logger().warning(
            f'A goal of order {goal_request.order} is rejected: from order {HIGHEST_ORDER + 1} '
            'on, the numbers do not fit into the message.'
        )
        return GoalResponse.REJECT

    def handle_accepted_callback(self, goal_handle: Any) -> None:
        """
        Execute a goal at once.

        Parameters
        ----------
        goal_handle
            The goal.

        """
        goal_handle.execute()

    def cancel_callback(self, goal_handle: Any) -> CancelResponse:
        """
        Accept that a goal is canceled.

        Parameters
        ----------
        goal_handle
            The goal.

        """
        self.get_logger().info('Received cancel request')
        return CancelResponse.ACCEPT

    def must_abort(self, goal_handle: Any) -> bool:
        """
        Whether the execution of a goal has to end early.

        Parameters
        ----------
        goal_handle
            The goal.

        """
        return False

    async def execute_callback(self, goal_handle: Any) -> Fibonacci.Result:
        """
        Compute the sequence, and publish it as feedback after each new number.

        Parameters
        ----------
        goal_handle
            The goal with its order.

        Returns
        -------
        Fibonacci.Result
            The sequence; it is empty if the goal was canceled or aborted.

        """
        logger = self.get_logger()
        logger.info('Executing goal...')
        feedback = Fibonacci.Feedback(sequence=[0, 1])
        for _ in range(1, goal_handle.request.order):
            if self.must_abort(goal_handle):
                goal_handle.abort()
                logger.info('Goal aborted')
                return Fibonacci.Result()
            if goal_handle.is_cancel_requested:
                goal_handle.canceled()
                logger.info('Goal canceled')
                return Fibonacci.Result()
            feedback.sequence.append(sum(feedback.sequence[-2:]))
            logger.info(f'Publishing feedback: {feedback.sequence}')
            goal_handle.publish_feedback(feedback)
            await sleep(self, self._period_s)
        goal_handle.succeed()
        logger.info(f'Returning result: {feedback.sequence}')
        return Fibonacci.Result(sequence=feedback.sequence)

    def destroy_node(self) -> None:
        """Destroy the action server, which the node does not do, and the node."""
        self._action_server.destroy()
        super().destroy_node()


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: MinimalActionServer(), args)


if __name__ == '__main__':
    sys.exit(main())
