# SPDX-License-Identifier: Apache-2.0
"""Publishers for playback of a bag."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
import time
from typing import Any

from rclpy.duration import Duration
from rclpy.qos import ReliabilityPolicy
from ros2bag.api.qos_profiles import playback_profile
from ros2bag.api.requests import ServiceOutlet
from ros2bag.storage.metadata import Topic
from ros2bag.storage.service_events import service_of
from ros2cli.messages.lookup import get_message, UnknownType

__all__ = ['Outlets']

MATCH_S = 2.0
PERIOD_S = 0.02
HASH_START = 'RIHS01_'


class Outlets:
    """
    Publishers for playback of a bag, one per topic.

    A topic whose type is not installed, or has changed since, is skipped with a warning.

    Parameters
    ----------
    node
        The node that publishes.
    topics
        The recorded topics to play.
    names
        The new names of remapped topics by their recorded names.
    overrides
        QoS profiles by recorded topic name; other topics get `playback_profile`.
    request_source
        For services, whose recorded requests are sent instead of publishing their events: one of
        `requests.SOURCES`; '' to publish the events.

    """

    def __init__(
        self,
        node: Any,
        topics: Iterable[Topic],
        names: Mapping[str, str],
        overrides: Mapping[str, Any],
        request_source: str = '',
    ) -> None:
        self._node = node
        self._publishers: dict[str, Any] = {}
        self._services: dict[str, ServiceOutlet] = {}
        self._request_source = request_source
        for topic in topics:
            if request_source and service_of(topic.name, topic.type_name):
                reason = self._add_service(topic, names.get(topic.name, topic.name))
                publisher = None
            else:
                publisher, reason = self._create(topic, names, overrides)
            if reason:
                node.get_logger().warning(f"Topic '{topic.name}' is not played: {reason}")
            elif publisher is not None:
                self._publishers[topic.name] = publisher

    @property
    def topics(self) -> list[str]:
        """Return the recorded names of the topics that are published."""
        return [*self._publishers, *self._services]

    def publish(self, topic: str, data: bytes) -> None:
        """
        Publish a serialized message.

        Parameters
        ----------
        topic
            The recorded name of the topic, one of `topics`.
        data
            The message in CDR, with its encapsulation header.

        """
        outlet = self._services.get(topic) or self._publishers[topic]
        outlet.publish(data)

    def wait_for_subscribers(self, *others: Any) -> None:
        """
        Wait until the existing subscribers and servers are matched, at most 2 s.

        Parameters
        ----------
        *others
            Further publishers to wait for, such as that of the clock.

        """
        graph = self._node.graph
        end = time.monotonic() + MATCH_S
        publishers = (*self._publishers.values(), *others)
        waiting = [each for each in publishers if graph.count_subscribers(each.topic_name)]
        servers = [each for each in self._services.values() if graph.count_services(each.service)]
        while (waiting or servers) and time.monotonic() < end:
            self._node.spin_once(PERIOD_S)
            waiting = [each for each in waiting if not each.get_subscription_count()]
            servers = [each for each in servers if not each.is_ready()]

    def wait_until_acked(self, limit_ms: float) -> None:
        """
        Wait until all reliable subscribers have acknowledged all messages, and servers answered.

        Parameters
        ----------
        limit_ms
            The timeout for all topics together, in ms; zero means no timeout.

        """
        end = time.monotonic() + (limit_ms / 1e3 or float('inf'))
        for service in self._services.values():
            service.wait_until_answered(end)
        for publisher in self._publishers.values():
            reliability = publisher.qos_profile.reliability
            while reliability == ReliabilityPolicy.RELIABLE and time.monotonic() < end:
                if publisher.wait_for_all_acked(Duration(seconds=PERIOD_S)):
                    break

    def _add_service(self, topic: Topic, name: str) -> str:
        """Create the client of a service; return '' or the reason why that is not possible."""
        try:
            self._services[topic.name] = ServiceOutlet(
                self._node, topic, name, self._request_source
            )
        except (UnknownType, RuntimeError) as error:
            return str(error)
        return ''

    def _create(
        self, topic: Topic, names: Mapping[str, str], overrides: Mapping[str, Any]
    ) -> tuple[Any, str]:
        """Create a publisher; return it, or None with the reason."""
        try:
            message_type = get_message(topic.type_name)
        except UnknownType as error:
            return None, str(error)
        profile = overrides.get(topic.name) or playback_profile(topic)
        name = names.get(topic.name, topic.name)
        publisher = self._node.create_publisher(message_type, name, profile)
        if topic.type_hash.startswith(HASH_START) and topic.type_hash not in self._hashes(name):
            self._node.destroy_publisher(publisher)
            return None, f"the definition of '{topic.type_name}' has changed since it was recorded"
        return publisher, ''

    def _hashes(self, name: str) -> set[str]:
        """Return the type hashes of our own publishers of a topic."""
        return {
            str(info.topic_type_hash)
            for info in self._node.get_publishers_info_by_topic(name)
            if info.node_name == self._node.get_name()
        }
