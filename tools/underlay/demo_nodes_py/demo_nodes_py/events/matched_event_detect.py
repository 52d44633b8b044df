# SPDX-License-Identifier: Apache-2.0
"""Matched events: a node is told when others subscribe to its topic, or publish on it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
import sys
from typing import Any

from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.subscription import Subscription
from rclpy.task import Future
from std_msgs.msg import String
from tf2_ros.program import run_node

__all__ = ['MatchedEventDetectNode', 'MultiPubNode', 'MultiSubNode', 'main']

PUBLISHED = 'pub_topic_matched_event_detect'
SUBSCRIBED = 'sub_topic_matched_event_detect'


class MatchedEventDetectNode(Node):
    """
    Logs each connection of its publisher and of its subscription.

    Parameters
    ----------
    pub_topic_name, sub_topic_name
        The topics of the publisher and of the subscription.
    options
        Further keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, pub_topic_name: str, sub_topic_name: str, **options: Any) -> None:
        super().__init__('matched_event_detect_node', **options)
        self._event: Future[None] = Future()
        self.create_publisher(
            String,
            pub_topic_name,
            10,
            event_callbacks=PublisherEventCallbacks(matched=self._logger_of('subscription')),
        )
        self.create_subscription(
            String,
            sub_topic_name,
            lambda _: None,
            10,
            event_callbacks=SubscriptionEventCallbacks(matched=self._logger_of('publisher')),
        )

    def get_future(self) -> Future[None]:
        """Return a future that is done when the next event has been logged."""
        self._event = Future()
        return self._event

    def _logger_of(self, other: str) -> Callable[[Any], None]:
        def log(status: Any) -> None:
            self.get_logger().info(_sentence(other, status))
            self._event.set_result(None)

        return log


def _sentence(other: str, status: Any) -> str:
    """Describe a change of the number of publishers or subscriptions."""
    if status.current_count == 0:
        return f'Last {other} is disconnected.'
    if status.current_count == status.current_count_change:
        return f'First {other} is connected.'
    return (
        f'The changed number of connected {other} is {status.current_count_change} '
        f'and current number of connected {other} is {status.current_count}.'
    )


class MultiSubNode(Node):
    """
    Makes and destroys subscriptions.

    Parameters
    ----------
    topic_name
        Their topic.
    options
        Further keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, topic_name: str, **options: Any) -> None:
        super().__init__('multi_sub_node', **options)
        self._topic_name = topic_name

    def create_one_sub(self) -> Subscription:
        """Create a subscription."""
        self.get_logger().info('Create a new subscription.')
        return self.create_subscription(String, self._topic_name, lambda _: None, 10)

    def destroy_one_sub(self, sub: Subscription) -> None:
        """
        Destroy a subscription.

        Parameters
        ----------
        sub
            The subscription.

        """
        self.get_logger().info('Destroy a subscription.')
        self.destroy_subscription(sub)


class MultiPubNode(Node):
    """
    Makes and destroys publishers.

    Parameters
    ----------
    topic_name
        Their topic.
    options
        Further keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, topic_name: str, **options: Any) -> None:
        super().__init__('multi_pub_node', **options)
        self._topic_name = topic_name

    def create_one_pub(self) -> Publisher:
        """Create a publisher."""
        self.get_logger().info('Create a new publisher.')
        return self.create_publisher(String, self._topic_name, 10)

    def destroy_one_pub(self, pub: Publisher) -> None:
        """
        Destroy a publisher.

        Parameters
        ----------
        pub
            The publisher.

        """
        self.get_logger().info('Destroy a publisher.')
        self.destroy_publisher(pub)


async def _connect_and_disconnect(
    node: MatchedEventDetectNode, create: Callable[[], Any], destroy: Callable[[Any], None]
) -> None:
    """Create two connections and destroy them, and wait for the event after each step."""
    created = []
    for _ in range(2):
        event = node.get_future()
        created.append(create())
        await event
    for each in created:
        event = node.get_future()
        destroy(each)
        await event


def _make_nodes(_: list[str]) -> MatchedEventDetectNode:
    node = MatchedEventDetectNode(PUBLISHED, SUBSCRIBED)
    node.companions = (MultiSubNode(PUBLISHED), MultiPubNode(SUBSCRIBED))
    return node


async def _work(node: MatchedEventDetectNode) -> None:
    subscriber, publisher = node.companions
    await _connect_and_disconnect(node, subscriber.create_one_sub, subscriber.destroy_one_sub)
    await _connect_and_disconnect(node, publisher.create_one_pub, publisher.destroy_one_pub)


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the nodes until all connections have been made and ended; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(_make_nodes, args, _work)


if __name__ == '__main__':
    sys.exit(main())
