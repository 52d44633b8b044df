# SPDX-License-Identifier: Apache-2.0
"""Spin a node in its own thread."""

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
    Spins a node in a thread until it is stopped or the program ends.

    Parameters
    ----------
    node
        The node to spin, with its own executor.

    Attributes
    ----------
    stop
        Callable that ends the thread and shuts the executor down; also runs when this object
        is garbage collected.

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
    """End the thread before the executor: rclpy's fails if it is shut down while spinning."""
    stop.set()
    if thread is not threading.current_thread():
        executor.create_task(lambda: None)  # wakes up the executor
        thread.join(_TIMEOUT_S)
        executor.shutdown(0.0)
