# SPDX-License-Identifier: Apache-2.0
"""Beginning of a chain: the messages of a topic."""

# ruff: noqa: N802
from __future__ import annotations

from typing import Any

from message_filters.simple_filter import SimpleFilter
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.subscription import Subscription

__all__ = ['Subscriber']

_DEPTH = 10


class Subscriber(SimpleFilter):
    """
    Filter that puts out the messages of a topic.

    Parameters
    ----------
    node
        The node that subscribes.
    msg_type, topic
        As for `Node.create_subscription`.
    qos_profile
        The quality of service, or the depth of the queue of a reliable subscription.
    options
        Further keyword arguments of `Node.create_subscription`.

    """

    def __init__(
        self,
        node: Node,
        msg_type: Any,
        topic: str,
        qos_profile: QoSProfile | int = _DEPTH,
        **options: Any,
    ) -> None:
        super().__init__()
        self.node = node
        self.topic = topic
        self.sub: Subscription = node.create_subscription(
            msg_type, topic, self.callback, qos_profile, **options
        )

    def callback(self, msg: Any) -> None:
        """
        Put out a message.

        Parameters
        ----------
        msg
            The message.

        """
        self.signalMessage(msg)

    def getTopic(self) -> str:
        """Return the name of the topic, as it was given."""
        return self.topic

    def unsubscribe(self) -> None:
        """Destroy the subscription."""
        self.node.destroy_subscription(self.sub)

    def __getattr__(self, name: str) -> Any:
        """Look up what a filter does not have, such as `topic_name`, in the subscription."""
        if name == 'sub':
            raise AttributeError(name)
        return getattr(self.sub, name)
