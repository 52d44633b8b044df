# SPDX-License-Identifier: Apache-2.0
"""An action server that accepts goals at once, and executes them later."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

from examples_rclpy_minimal_action_server.server import MinimalActionServer
from tf2_ros.executing import sleep
from tf2_ros.program import run_node

__all__ = ['DeferringActionServer', 'main']

DELAY_S = 5.0


class DeferringActionServer(MinimalActionServer):
    """
    Executes a goal some seconds after it was accepted.

    Parameters
    ----------
    delay_s
        The time until then, in s.
    options
        Keyword arguments of `MinimalActionServer`.

    """

    def __init__(self, delay_s: float = DELAY_S, **options: Any) -> None:
        super().__init__(**options)
        self._delay_s = delay_s

    def handle_accepted_callback(self, goal_handle: Any) -> None:
        """
        Put the execution of a goal off.

        Parameters
        ----------
        goal_handle
            The goal.

        """
        self.get_logger().info('Deferring execution...')

        async def execute() -> None:
            await sleep(self, self._delay_s)
            goal_handle.execute()

        self.executor.create_task(execute)


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: DeferringActionServer(), args)


if __name__ == '__main__':
    sys.exit(main())
