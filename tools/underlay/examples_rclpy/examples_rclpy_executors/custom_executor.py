# SPDX-License-Identifier: Apache-2.0
"""An executor of its own that never lets the callbacks of important nodes wait for others."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Future, ThreadPoolExecutor
import sys
from typing import Any

from examples_rclpy_executors.listener import Listener
from examples_rclpy_executors.program import run_executor
from examples_rclpy_executors.talker import Talker
from rclpy.executors import Executor, ShutdownException, TimeoutException
from rclpy.node import Node
from rclpy.task import Task
from std_msgs.msg import String

__all__ = ['Estopper', 'PriorityExecutor', 'main']

THREADS = 4


class Estopper(Node):
    """
    Logs what comes on `estop`, as a node that has to react at once.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('estopper', **options)
        self.create_subscription(String, 'estop', self.estop_callback, 10)

    def estop_callback(self, msg: String) -> None:
        """
        Log a message.

        Parameters
        ----------
        msg
            The message.

        """
        self.get_logger().info(f'I heard: "{msg.data}"')


class PriorityExecutor(Executor):
    """Executor with threads for nodes of high priority, and one thread for all others."""

    def __init__(self) -> None:
        super().__init__()
        self._important: set[Node] = set()
        self._for_important = ThreadPoolExecutor(max_workers=THREADS)
        self._for_others = ThreadPoolExecutor(max_workers=1)
        self._running: list[Future[None]] = []

    def add_high_priority_node(self, node: Node) -> None:
        """
        Add a node whose callbacks do not wait for those of other nodes.

        Parameters
        ----------
        node
            The node.

        """
        self._important.add(node)
        self.add_node(node)

    def spin_once(self, timeout_sec: float | None = None) -> None:
        """
        Hand the next callback that is due to a thread; raise the error of one that has failed.

        Parameters
        ----------
        timeout_sec
            The maximum time to wait for one, in s; unlimited by default.

        """
        for each in [each for each in self._running if each.done()]:
            self._running.remove(each)
            each.result()
        try:
            task, _, node = self.wait_for_ready_callbacks(timeout_sec=timeout_sec)
        except (TimeoutException, ShutdownException):
            return
        threads = self._for_important if node in self._important else self._for_others
        self._running.append(threads.submit(self._execute, task))

    def _execute(self, task: Task[Any]) -> None:
        task()
        if error := task.exception():
            raise error

    def shutdown(self, timeout_sec: float | None = None) -> bool:
        """
        Stop, after the callbacks that have begun.

        Parameters
        ----------
        timeout_sec
            The maximum time to wait for them, in s; unlimited by default.

        Returns
        -------
        bool
            Whether they ended in time.

        """
        has_ended: bool = super().shutdown(timeout_sec)
        for threads in (self._for_important, self._for_others):
            threads.shutdown(wait=has_ended)
        return has_ended


def _make_executor() -> Executor:
    executor = PriorityExecutor()
    executor.add_high_priority_node(Estopper())
    executor.add_node(Listener())
    executor.add_node(Talker())
    return executor


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the nodes; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_executor(_make_executor, args)


if __name__ == '__main__':
    sys.exit(main())
