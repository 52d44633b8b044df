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
        thread = threading.Thread(
            target=_spin, args=(executor,), name='transform listener', daemon=True
        )
        thread.start()
        self.stop = weakref.finalize(self, _stop, executor, thread)


def _spin(executor: SingleThreadedExecutor) -> None:
    try:
        executor.spin()
    except ExternalShutdownException:
        pass


def _stop(executor: SingleThreadedExecutor, thread: threading.Thread) -> None:
    executor.shutdown(_TIMEOUT_S)
    if thread is not threading.current_thread():
        thread.join(_TIMEOUT_S)
