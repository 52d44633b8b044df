# SPDX-License-Identifier: Apache-2.0
"""Hear a topic when there is time for it, and not in between."""

from __future__ import annotations

from collections.abc import Iterator
import time
from typing import Any, TYPE_CHECKING

from rclpy.callback_groups import ReentrantCallbackGroup

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.qos import QoSProfile

__all__ = ['PolledTopic', 'WaitingGroup']


class WaitingGroup(ReentrantCallbackGroup):
    """Subscriptions that the executor leaves alone."""

    def can_execute(self, entity: Any) -> bool:
        """Tell the executor not to wait for them."""
        return False


class PolledTopic:
    """
    A topic whose messages wait until they are taken; those beyond the depth are lost.

    For an executor to wake for each message takes longer than to take several at once.
    """

    def __init__(self, node: Node, kind: type, topic: str, qos: QoSProfile) -> None:
        """Subscribe a topic."""
        self._node = node
        self._depth = qos.depth
        self._subscription = node.create_subscription(
            kind, topic, lambda message: None, qos, callback_group=WaitingGroup()
        )

    def take(self) -> Iterator[tuple[Any, float]]:
        """Yield the messages that wait, each with the time at which it came (`time.time`)."""
        handle, kind = self._subscription.handle, self._subscription.msg_type
        for _ in range(self._depth):
            with handle:
                found = handle.take_message(kind, False)
            if found is None:
                return
            message, about = found
            yield message, about['received_timestamp'] / 1e9 or time.time()

    def close(self) -> None:
        """Subscribe no longer."""
        self._node.destroy_subscription(self._subscription)
