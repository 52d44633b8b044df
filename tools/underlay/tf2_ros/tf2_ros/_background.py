# SPDX-License-Identifier: Apache-2.0
"""Let a node work in a thread of its own."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING
import weakref

from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor

if TYPE_CHECKING:
    from rclpy.node import Node

_TIMEOUT_S = 10.0


class Background:
    """
    Spins a node in a thread until it is stopped, at the latest when the program ends.

    Parameters
    ----------
    node
        What is spun, with an executor of its own.

    Attributes
    ----------
    stop
        Ends the thread and shuts the executor down when called; also runs when this object is
        garbage collected.

    """

    def __init__(self, node: Node) -> None:
        executor = SingleThreadedExecutor(context=node.context)
        executor.add_node(node)
        stop = threading.Event()
        thread = threading.Thread(
            target=_spin, args=(executor, stop), name='transform listener', daemon=True
        )
        thread.start()
        self.stop = weakref.finalize(self, _stop, executor, stop, thread)


def _spin(executor: SingleThreadedExecutor, stop: threading.Event) -> None:
    try:
        while not stop.is_set():
            executor.spin_once()
    except ExternalShutdownException:
        pass


def _stop(
    executor: SingleThreadedExecutor, stop: threading.Event, thread: threading.Thread
) -> None:
    """End the thread, and then the executor: rclpy's breaks if it is shut down while it spins."""
    stop.set()
    if thread is not threading.current_thread():
        executor.create_task(lambda: None)  # it looks up from its waiting
        thread.join(_TIMEOUT_S)
        executor.shutdown(0.0)
