# SPDX-License-Identifier: Apache-2.0
"""A talker and a listener in one process, whose callbacks one thread executes."""

from __future__ import annotations

from collections.abc import Sequence
import sys

from examples_rclpy_executors.listener import Listener
from examples_rclpy_executors.program import run_executor
from examples_rclpy_executors.talker import Talker
from rclpy.executors import Executor, SingleThreadedExecutor

__all__ = ['main']


def _make_executor() -> Executor:
    executor = SingleThreadedExecutor()
    executor.add_node(Talker())
    executor.add_node(Listener())
    return executor


def main(args: Sequence[str] | None = None) -> int:
    """
    Run both nodes; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_executor(_make_executor, args)


if __name__ == '__main__':
    sys.exit(main())
