# SPDX-License-Identifier: Apache-2.0
"""Spin a node in a background thread."""

from __future__ import annotations

import threading
from typing import Any, Optional, TYPE_CHECKING

if TYPE_CHECKING:
    from rclpy.context import Context
    from rclpy.node import Node

_PERIOD_S = 0.1
_TIMEOUT_S = 10.0


class MessagePump:
    """
    Spins a node in its own thread; also a context manager.

    Parameters
    ----------
    node
        The node, which must not be spun elsewhere.
    context
        The ROS context of the executor; None for that of the node.

    """

    def __init__(self, node: Node, context: Optional[Context] = None) -> None:
        from rclpy.executors import SingleThreadedExecutor

        self._executor = SingleThreadedExecutor(
            context=node.context if context is None else context
        )
        self._executor.add_node(node)
        self._stopping = False
        self._thread = threading.Thread(target=self._spin, name='message pump', daemon=True)

    def start(self) -> None:
        """Start spinning the node."""
        self._thread.start()

    def stop(self) -> None:
        """Stop spinning; the node is not destroyed."""
        self._stopping = True
        self._executor.wake()
        self._thread.join(_TIMEOUT_S)
        if self._thread.is_alive():
            raise RuntimeError(
                f'a callback of the node has not returned for {_TIMEOUT_S:g} s, so the node '
                'cannot be stopped'
            )
        self._executor.shutdown()

    def __enter__(self) -> MessagePump:
        self.start()
        return self

    def __exit__(self, *exc_info: Any) -> None:
        self.stop()

    def _spin(self) -> None:
        while not self._stopping:
            self._executor.spin_once(timeout_sec=_PERIOD_S)
