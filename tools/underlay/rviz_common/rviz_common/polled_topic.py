# SPDX-License-Identifier: Apache-2.0
"""Subscriptions that are polled."""

from __future__ import annotations

from collections.abc import Iterator
import time
from typing import Any, TYPE_CHECKING
from weakref import WeakKeyDictionary, WeakSet

from rclpy.callback_groups import ReentrantCallbackGroup

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.qos import QoSProfile

__all__ = ['PolledTopic', 'WaitingGroup', 'rest_all', 'resume_all']

_topics: WeakKeyDictionary[Node, WeakSet[PolledTopic]] = WeakKeyDictionary()


class WaitingGroup(ReentrantCallbackGroup):
    """
    Callback group of subscriptions that the executor ignores.

    SingleThreadedExecutor asks the group; a `GuardedNode` hides them from other executors.
    """

    def can_execute(self, entity: Any) -> bool:
        """
        Whether the executor may wait for an entity: never.

        Parameters
        ----------
        entity
            The subscription that the executor asks about.

        """
        return False


class PolledTopic:
    """
    A subscription whose messages are queued until they are taken; the queue depth limits them.

    Waking an executor for each message costs more than taking several at once.

    Parameters
    ----------
    node
        The node that subscribes.
    kind
        The class of the messages.
    topic
        The topic.
    qos
        The QoS profile, whose depth is the maximum number of queued messages.

    """

    def __init__(self, node: Node, kind: type, topic: str, qos: QoSProfile) -> None:
        self.topic = topic
        self._node, self._kind, self._qos = node, kind, qos
        self._subscription: Any = None
        self.resume()
        _topics.setdefault(node, WeakSet()).add(self)

    def take(self) -> Iterator[tuple[Any, float]]:
        """Yield the queued messages, each with its time of reception (`time.time`)."""
        if self._subscription is None:
            return
        handle = self._subscription.handle
        for _ in range(self._qos.depth):
            with handle:
                found = handle.take_message(self._kind, False)
            if found is None:
                return
            message, about = found
            yield message, about['received_timestamp'] / 1e9 or time.time()

    def rest(self) -> None:
        """Unsubscribe until `resume`."""
        if self._subscription is not None:
            self._node.destroy_subscription(self._subscription)
            self._subscription = None

    def resume(self) -> None:
        """Subscribe."""
        if self._subscription is None:
            self._subscription = self._node.create_subscription(
                self._kind,
                self.topic,
                lambda message: None,
                self._qos,
                callback_group=WaitingGroup(),
            )

    def close(self) -> None:
        """Unsubscribe."""
        self.rest()
        _topics.get(self._node, WeakSet()).discard(self)


def rest_all(node: Node) -> None:
    """
    Unsubscribe from all polled topics of a node until `resume_all`.

    Parameters
    ----------
    node
        The node.

    """
    for topic in list(_topics.get(node, ())):
        topic.rest()


def resume_all(node: Node) -> None:
    """
    Resubscribe to all polled topics of a node, after `rest_all`.

    Parameters
    ----------
    node
        The node.

    """
    for topic in list(_topics.get(node, ())):
        topic.resume()
