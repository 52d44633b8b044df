# SPDX-License-Identifier: Apache-2.0
"""
An action client whose two goals are executed at the same time, as with `asyncio.gather`.

The coroutines run in the executor of rclpy, so that no second loop of events is needed.
"""

from __future__ import annotations

from collections.abc import Sequence
import sys

from examples_rclpy_minimal_action_client.client import MinimalActionClient
from tf2_ros.program import run_node

__all__ = ['main']

GOALS = 2


async def _send_goals(node: MinimalActionClient) -> None:
    goals = [node.executor.create_task(node.send_goal) for _ in range(GOALS)]
    for goal in goals:
        await goal


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(
        lambda _: MinimalActionClient('minimal_action_client_asyncio'), args, _send_goals
    )


if __name__ == '__main__':
    sys.exit(main())
