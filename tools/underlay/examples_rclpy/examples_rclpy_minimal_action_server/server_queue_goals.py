# SPDX-License-Identifier: Apache-2.0
"""An action server that executes one goal at a time, in the order in which they came."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
import sys
from typing import Any

from example_interfaces.action import Fibonacci
from examples_rclpy_minimal_action_server.server import MinimalActionServer
from tf2_ros.program import run_node

__all__ = ['QueueingActionServer', 'main']


class QueueingActionServer(MinimalActionServer):
    """
    Lets goals wait for those before them.

    Parameters
    ----------
    options
        Keyword arguments of `MinimalActionServer`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__(**options)
        self._goal_queue: deque[Any] = deque()
        self._current_goal: Any = None

    def handle_accepted_callback(self, goal_handle: Any) -> None:
        """
        Execute a goal at once or, while there is another one, after it.

        Parameters
        ----------
        goal_handle
            The goal.

        """
        if self._current_goal is None:
            self._current_goal = goal_handle
            goal_handle.execute()
        else:
            self._goal_queue.append(goal_handle)
            self.get_logger().info('Goal put in the queue')

    async def execute_callback(self, goal_handle: Any) -> Fibonacci.Result:
        """
        Compute the sequence, then execute the next goal.

        Parameters
        ----------
        goal_handle
            The goal.

        Returns
        -------
        Fibonacci.Result
            As of `MinimalActionServer`.

        """
        try:
            return await super().execute_callback(goal_handle)
        finally:
            self._current_goal = self._goal_queue.popleft() if self._goal_queue else None
            if self._current_goal is not None:
                self.get_logger().info('Next goal pulled from the queue')
                self._current_goal.execute()


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: QueueingActionServer(), args)


if __name__ == '__main__':
    sys.exit(main())
