# SPDX-License-Identifier: Apache-2.0
"""A client that is asked by the callback of a timer, and a callback for its response."""

from __future__ import annotations

from collections.abc import Sequence
import sys

from examples_rclpy_minimal_client.client_async_member_function import MinimalClientAsync
from rclpy.task import Future
from tf2_ros.program import run_node

__all__ = ['main']

PERIOD_S = 0.5


async def _ask(node: MinimalClientAsync) -> None:
    end: Future[None] = Future(executor=node.executor)

    def call() -> None:
        timer.cancel()
        response = node.executor.create_task(node.send_request)
        response.add_done_callback(lambda _: end.set_result(None))

    timer = node.create_timer(PERIOD_S, call)
    await end


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: MinimalClientAsync('minimal_client'), args, _ask)


if __name__ == '__main__':
    sys.exit(main())
