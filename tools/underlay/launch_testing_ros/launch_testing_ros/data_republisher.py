# SPDX-License-Identifier: Apache-2.0
"""Republish the messages of a topic, changed, on another one."""

from __future__ import annotations

from collections.abc import Callable
import threading
from typing import Any, Optional

__all__ = ['DataRepublisher']


class DataRepublisher:
    """
    Republishes messages after a function has changed them, such as to inject faults in a test.

    It starts immediately. The node must spin, for instance in a `MessagePump`.

    Parameters
    ----------
    node
        The node that subscribes and publishes.
    listen_topic
        The topic of the messages.
    publish_topic
        The topic of the changed messages.
    msg_type
        The type of the messages.
    transform_fn
        Called with each message. It returns the message to publish, or None to publish none.

    """

    def __init__(
        self,
        node: Any,
        listen_topic: str,
        publish_topic: str,
        msg_type: Any,
        transform_fn: Callable[[Any], Optional[Any]],
    ) -> None:
        self._node = node
        self._transform = transform_fn
        self._lock = threading.Lock()
        self._received = 0
        self._republished: list[Any] = []
        self._publisher = node.create_publisher(msg_type, publish_topic, 10)
        self._subscription = node.create_subscription(msg_type, listen_topic, self._on_message, 10)

    def _on_message(self, message: Any) -> None:
        changed = self._transform(message)
        with self._lock:
            self._received += 1
            if changed is None:
                return
            self._republished.append(changed)
        self._publisher.publish(changed)

    def get_num_received(self) -> int:
        """The number of messages that have arrived."""
        with self._lock:
            return self._received

    def get_num_republished(self) -> int:
        """The number of messages that have been published, which leaves out the dropped ones."""
        with self._lock:
            return len(self._republished)

    def get_republished(self) -> list[Any]:
        """The messages that have been published, oldest first."""
        with self._lock:
            return list(self._republished)

    def shutdown(self) -> None:
        """Stop republishing; the published messages remain available."""
        self._node.destroy_subscription(self._subscription)
        self._node.destroy_publisher(self._publisher)
