# SPDX-License-Identifier: Apache-2.0
"""Detect other publishers on topics that only one node may publish."""

from __future__ import annotations

from collections.abc import Sequence

from rclpy.clock import Clock, ClockType
from rclpy.node import Node

PERIOD_S = 3.0


class DuplicatePublisherCheck:
    """
    Duplicate publisher check: warns of topics with another publisher, as from a second simulator.

    It checks every few seconds. A publisher must be seen twice in a row, as a node that ends may
    stay visible for a moment.

    Parameters
    ----------
    node
        The node that publishes the topics, and logs the warning.
    topics
        Topics that only this node may publish; names are relative to its namespace or absolute.

    """

    def __init__(self, node: Node, topics: Sequence[str]) -> None:
        self._node = node
        self._topics = tuple(node.resolve_topic_name(topic) for topic in topics)
        self._seen: set[str] = set()
        self._said: set[str] = set()
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = node.create_timer(PERIOD_S, self._look, clock=steady)

    def _look(self) -> None:
        """Warn of duplicates that persist, once for as long as they stay."""
        duplicates = {topic for topic in self._topics if self._node.count_publishers(topic) > 1}
        lasting = duplicates & self._seen
        if lasting - self._said:
            self._node.get_logger().warning(sentence(sorted(lasting - self._said)))
        self._seen, self._said = duplicates, lasting


def sentence(topics: Sequence[str]) -> str:
    """
    Build the warning about topics that have more than one publisher.

    Parameters
    ----------
    topics
        Full names of the topics.

    """
    names = ', '.join(f"'{topic}'" for topic in topics)
    return (
        f'Another node publishes {names}, too: who listens gets a mixture. Perhaps a second robot '
        'or simulator runs. End one of them, or give it a namespace (a mock robot) or a '
        'ROS_DOMAIN_ID (a simulator) of its own. One that was killed is seen for some 20 s more.'
    )
