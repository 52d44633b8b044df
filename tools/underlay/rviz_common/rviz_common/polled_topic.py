# SPDX-License-Identifier: Apache-2.0
"""Hear a topic when there is time for it, and not in between."""

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
    Subscriptions that the executor leaves alone.

    SingleThreadedExecutor asks the group, and a `GuardedNode` does not show them to others.
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
    A subscription whose messages wait until they are taken; those beyond the depth are lost.

    For an executor to wake for each message takes longer than to take several at once.

    Parameters
    ----------
    node
        The node that subscribes.
    kind
        The class of the messages.
    topic
        The topic.
    qos
        The quality of service, whose depth says how many messages can wait.

    """

    def __init__(self, node: Node, kind: type, topic: str, qos: QoSProfile) -> None:
        self.topic = topic
        self._node, self._kind, self._qos = node, kind, qos
        self._subscription: Any = None
        self.resume()
        _topics.setdefault(node, WeakSet()).add(self)

    def take(self) -> Iterator[tuple[Any, float]]:
        """Yield the messages that wait, each with the time at which it came (`time.time`)."""
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
        """Subscribe no longer until `resume`."""
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
        """Subscribe no longer."""
        self.rest()
        _topics.get(self._node, WeakSet()).discard(self)


def rest_all(node: Node) -> None:
    """
    Unsubscribe all polled topics of a node until `resume_all`.

    Parameters
    ----------
    node
        The node.

    """
    for topic in list(_topics.get(node, ())):
        topic.rest()


def resume_all(node: Node) -> None:
    """
    Subscribe all polled topics of a node again, after `rest_all`.

    Parameters
    ----------
    node
        The node.

    """
    for topic in list(_topics.get(node, ())):
        topic.resume()
