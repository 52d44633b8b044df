# SPDX-License-Identifier: Apache-2.0
"""An action server with one goal at a time: a new goal aborts the one before."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

from examples_rclpy_minimal_action_server.server import MinimalActionServer
from tf2_ros.program import run_node

__all__ = ['SingleGoalActionServer', 'main']


class SingleGoalActionServer(MinimalActionServer):
    """
    Aborts a goal as soon as there is a newer one.

    Parameters
    ----------
    options
        Keyword arguments of `MinimalActionServer`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__(**options)
        self._goal_handle: Any = None

    def handle_accepted_callback(self, goal_handle: Any) -> None:
        """
        Execute a goal instead of the one before.

        Parameters
        ----------
        goal_handle
            The goal.

        """
        if self._goal_handle is not None and self._goal_handle.is_active:
            self.get_logger().info('Aborting previous goal')
        self._goal_handle = goal_handle
        goal_handle.execute()

    def must_abort(self, goal_handle: Any) -> bool:
        """
        Whether there is a newer goal.

        Parameters
        ----------
        goal_handle
            The goal.

        """
        return goal_handle is not self._goal_handle


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: SingleGoalActionServer(), args)


if __name__ == '__main__':
    sys.exit(main())
