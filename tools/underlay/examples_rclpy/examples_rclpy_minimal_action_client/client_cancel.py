# SPDX-License-Identifier: Apache-2.0
"""An action client that cancels its goal after some time."""

from __future__ import annotations

from collections.abc import Sequence
import sys

from examples_rclpy_minimal_action_client.client import MinimalActionClient
from tf2_ros.executing import response_of, sleep
from tf2_ros.program import run_node

__all__ = ['main']

PATIENCE_S = 2.0


async def _send_and_cancel(node: MinimalActionClient) -> None:
    goal = await node.accepted_goal()
    if goal is None:
        return
    await sleep(node, PATIENCE_S)
    node.get_logger().info('Canceling goal')
    response = await response_of(node, goal.cancel_goal_async)
    text = 'Goal successfully canceled' if response.goals_canceling else 'Goal failed to cancel'
    node.get_logger().info(text)


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: MinimalActionClient(), args, _send_and_cancel)


if __name__ == '__main__':
    sys.exit(main())
