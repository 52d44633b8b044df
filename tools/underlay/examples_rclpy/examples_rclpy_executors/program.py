# SPDX-License-Identifier: Apache-2.0
"""Programs with an executor of rclpy of their own choice."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from rclpy.executors import Executor
from tf2_ros.program import run, wait_for_signal

__all__ = ['run_executor']

LOOK_S = 0.2
"""How often it looks for a signal, if there is nothing else to do."""


def run_executor(make: Callable[[], Executor], args: Sequence[str] | None = None) -> int:
    """
    Spin an executor until SIGINT or SIGTERM; return the exit status.

    Parameters
    ----------
    make
        Makes the executor with its nodes.
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """

    def work(_: list[str]) -> None:
        executor = make()
        nodes = executor.get_nodes()
        while not wait_for_signal(0.0):
            executor.spin_once(timeout_sec=LOOK_S)
        executor.shutdown()
        for node in nodes:
            node.destroy_node()

    return run(list, work, args)
