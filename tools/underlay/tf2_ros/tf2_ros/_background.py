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
    """Spins a node until it is stopped, at the latest when the program ends."""

    def __init__(self, node: Node) -> None:
        """Start the thread."""
        executor = SingleThreadedExecutor(context=node.context)
        executor.add_node(node)
        stopping = threading.Event()
        thread = threading.Thread(
            target=_spin, args=(executor, stopping), name='transform listener', daemon=True
        )
        thread.start()
        self.stop = weakref.finalize(self, _stop, executor, stopping, thread)


def _spin(executor: SingleThreadedExecutor, stopping: threading.Event) -> None:
    try:
        while executor.context.ok() and not stopping.is_set():
            executor.spin_once()
    except ExternalShutdownException:
        pass


def _stop(
    executor: SingleThreadedExecutor, stopping: threading.Event, thread: threading.Thread
) -> None:
    stopping.set()
    executor.wake()
    if thread is not threading.current_thread():
        thread.join(_TIMEOUT_S)
    executor.shutdown()
