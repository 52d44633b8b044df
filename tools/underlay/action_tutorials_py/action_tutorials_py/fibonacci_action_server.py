# SPDX-License-Identifier: Apache-2.0
"""An action server that computes the Fibonacci sequence, one number per second."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

from action_tutorials_interfaces.action import Fibonacci
from rclpy.action import ActionServer, GoalResponse
from rclpy.node import Node
from tf2_ros.executing import RESULT_MARGIN_S, sleep
from tf2_ros.program import run_node

__all__ = ['FibonacciActionServer', 'main']

HIGHEST_ORDER = 46
"""From the next order on, the last number does not fit into the 32 bits of the message."""
_PERIOD_S = 1.0
_RESULT_TIMEOUT_S = 900.0


class FibonacciActionServer(Node):
    """
    Offers the action `fibonacci`.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('fibonacci_action_server', **options)
        self._server = ActionServer(
            self,
            Fibonacci,
            'fibonacci',
            self.execute_callback,
            goal_callback=self._check,
            result_timeout=_RESULT_TIMEOUT_S + RESULT_MARGIN_S,
        )

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
            The sequence.

        """
        self.get_logger().info('Executing goal...')
        feedback = Fibonacci.Feedback(partial_sequence=[0, 1])
        for _ in range(1, goal_handle.request.order):
            feedback.partial_sequence.append(sum(feedback.partial_sequence[-2:]))
            self.get_logger().info(f'Feedback: {feedback.partial_sequence}')
            goal_handle.publish_feedback(feedback)
            await sleep(self, _PERIOD_S)
        goal_handle.succeed()
        return Fibonacci.Result(sequence=feedback.partial_sequence)

    def _check(self, goal: Fibonacci.Goal) -> GoalResponse:
        if goal.order <= HIGHEST_ORDER:
            return GoalResponse.ACCEPT
        self.get_logger().warning(
            f'A goal of order {goal.order} is rejected: from order {HIGHEST_ORDER + 1} on, the '
            'numbers do not fit into the message.'
        )
        return GoalResponse.REJECT

    def destroy_node(self) -> None:
        """Destroy the action server, which the node does not do, and the node."""
        self._server.destroy()
        super().destroy_node()


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: FibonacciActionServer(), args)


if __name__ == '__main__':
    sys.exit(main())
