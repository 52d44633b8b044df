# SPDX-License-Identifier: Apache-2.0
"""Record topics: discover them, subscribe, and pass their messages to the writer."""

from __future__ import annotations

from collections.abc import Callable
import time
from typing import Any

from rclpy.event_handler import SubscriptionEventCallbacks
from ros2bag.api.common_arguments import TopicFilter
from ros2bag.api.control import PauseSwitch
from ros2bag.api.qos_profiles import offered_by
from ros2bag.storage.bag_writer import BagWriter
from ros2bag.storage.latched import RecordedMessage
from ros2bag.storage.metadata import Topic
from ros2bag.storage.snapshot import Snapshot
from ros2cli.graph.graph import Graph
from ros2cli.messages.lookup import get_message, UnknownType
from ros2topic.api import get_topic_names_and_types
from ros2topic.api.qos import matching_qos

__all__ = ['Recorder']

TURN_S = 0.02
REST_S = 5.0


class Recorder:
    """
    Recorder that discovers topics, subscribes to them, and passes their messages to a bag writer.

    Call `discover` periodically while the node is spun, and `take_rest` at the end.

    Parameters
    ----------
    node
        The node that subscribes.
    writer
        The bag that is written, or what keeps messages for it.
    topic_filter
        Which topics to record.
    switch
        The paused state: while paused, only latched messages are kept, for `release_held`.
    use_sim_time
        Whether messages are stamped with the time of `/clock` instead of their reception time.
    include_unpublished
        Whether topics without a publisher are added to the list of topics, too.
    ignore_leaves
        Whether topics are left out that nobody else subscribes to.
    overrides
        QoS profiles to subscribe with, by topic name.

    Attributes
    ----------
    received_count
        The number of received messages, paused or not.

    """

    def __init__(
        self,
        node: Any,
        writer: BagWriter | Snapshot,
        topic_filter: TopicFilter,
        switch: PauseSwitch,
        *,
        use_sim_time: bool = False,
        include_unpublished: bool = False,
        ignore_leaves: bool = False,
        overrides: dict[str, Any] | None = None,
    ) -> None:
        self._node = node
        self._writer = writer
        self._filter = topic_filter
        self._switch = switch
        self._use_sim_time = use_sim_time
        self._include_unpublished = include_unpublished
        self._ignore_leaves = ignore_leaves
        self._overrides = overrides or {}
        self._topics: dict[str, RecordedTopic | None] = {}
        self._latched: set[str] = set()
        self._publisher_counts: dict[str, int] = {}
        self._held: list[RecordedMessage] = []
        self._end_ns: int | None = None
        self.received_count = 0

    @property
    def topic_count(self) -> int:
        """Return the number of subscribed topics."""
        return sum(topic is not None for topic in self._topics.values())

    @property
    def missing(self) -> list[str]:
        """Return the topics that were requested by name and have not appeared."""
        return sorted(self._filter.named.difference(self._topics))

    def discover(self) -> None:
        """Subscribe to new topics, and adapt to changes of their publishers."""
        graph = self._node.watch.updated()
        for name, types in get_topic_names_and_types(node=graph, include_hidden_topics=True):
            if self._filter.wants(name, types[0]) and self._has_changed(graph, name):
                self._follow(graph, name, types)

    def release_held(self) -> None:
        """Record the latched messages that arrived during the pause that has ended."""
        held, self._held = self._held, []
        for message in held:
            self._writer.write(message.logged_at(self.now_ns()))

    def take_rest(self) -> None:
        """
        Record all messages that arrived before now, even on a busy machine, and no later ones.

        It ends when no messages are left, or when each topic has been served and only later
        messages arrive; after 5 s at the latest.
        """
        self._end_ns = time.time_ns()
        end_s = time.monotonic() + REST_S
        turns = pauses = 0
        while pauses < 2 and turns <= 2 * (1 + self.topic_count) and time.monotonic() < end_s:
            before, began_s = self.received_count, time.monotonic()
            self._node.spin_once(TURN_S)
            if self.received_count > before:
                turns = pauses = 0
            elif time.monotonic() - began_s >= TURN_S:
                pauses += 1
            else:
                turns += 1

    def _has_changed(self, graph: Graph, name: str) -> bool:
        """Whether the publishers of a topic have changed since the last discovery."""
        is_new = name not in self._topics
        if self._ignore_leaves and is_new and not graph.count_subscribers(name):
            return False
        count = graph.count_publishers(name)
        if count == self._publisher_counts.get(name, 0) and not (
            self._include_unpublished and is_new
        ):
            return False
        self._publisher_counts[name] = count
        return True

    def _follow(self, graph: Graph, name: str, types: list[str]) -> None:
        publishers = graph.get_publishers_info_by_topic(name)
        if name not in self._topics and (publishers or self._include_unpublished):
            self._topics[name] = self._create(name, types)
        topic = self._topics.get(name)
        if topic is not None and (publishers or self._include_unpublished):
            self._warn_of_types(topic, types)
            self._note(topic.update(publishers))

    def _warn_of_types(self, topic: RecordedTopic, types: list[str]) -> None:
        """Warn that messages of other types on the topic are not recorded."""
        others = [each for each in types if each != topic.type_name]
        if others:
            self._node.get_logger().warning(
                f"Only {topic.type_name} is recorded on topic '{topic.name}': "
                f'it now has {", ".join(others)} as well'
            )

    def _note(self, topic: Topic) -> None:
        self._writer.set_topic(topic)
        if topic.is_latched:
            self._latched.add(topic.name)

    def _create(self, name: str, types: list[str]) -> RecordedTopic | None:
        """Create the subscription, or log why this topic cannot be recorded."""
        logger = self._node.get_logger()
        if len(types) > 1:
            logger.warning(
                f"Topic '{name}' is not recorded: it has several types, {', '.join(types)}"
            )
            return None
        try:
            message_type = get_message(types[0])
        except UnknownType as error:
            logger.warning(f"Topic '{name}' is not recorded: {error}")
            return None
        logger.info(f"Subscribed to topic '{name}'")
        return RecordedTopic(
            self._node,
            (name, types[0], message_type),
            self._receiver(name),
            self._overrides.get(name),
        )

    def _receiver(self, name: str) -> Callable[[bytes, dict[str, int]], None]:
        def receive(data: bytes, info: dict[str, int]) -> None:
            if self._end_ns is not None and info['received_timestamp'] > self._end_ns:
                return
            self.received_count += 1
            log_ns = self.now_ns() if self._use_sim_time else info['received_timestamp']
            sequence = info['publication_sequence_number'] or 0
            message = RecordedMessage(name, data, log_ns, info['source_timestamp'], sequence)
            if not self._switch.is_paused:
                self._writer.write(message)
            elif name in self._latched:
                self._held.append(message)

        return receive

    def now_ns(self) -> int:
        """Return the time that a message gets now, in ns since the epoch."""
        if self._use_sim_time:
            return int(self._node.get_clock().now().nanoseconds)
        return time.time_ns()


class RecordedTopic:
    """
    Serialized subscription to a topic that adapts its QoS to the publishers.

    When a publisher appears that offers less than the others, the subscription is replaced so that
    it receives from all of them. `update` creates it.

    Parameters
    ----------
    node
        The node that subscribes.
    what
        The name of the topic, the name of its type, and the class of its type.
    receive
        Called with each serialized message and the message info of rclpy.
    override
        The QoS profile to subscribe with regardless of the publishers; None adapts to them.

    """

    def __init__(
        self,
        node: Any,
        what: tuple[str, str, Any],
        receive: Callable[[bytes, dict[str, int]], None],
        override: Any = None,
    ) -> None:
        self._node = node
        self.name, self.type_name, self._message_type = what
        self._receive = receive
        self._override = override
        self._profile: Any = None
        self._subscription: Any = None

    def update(self, publishers: list[Any]) -> Topic:
        """
        Subscribe, or subscribe again, so that all publishers are received.

        Parameters
        ----------
        publishers
            Endpoint infos of rclpy; may be empty.

        Returns
        -------
        Topic
            The topic with the type hash of the first publisher and the QoS that all of them offer.

        """
        profile = self._override or matching_qos(publishers)[0]
        if self._subscription is None or self._is_weaker(profile):
            self._subscribe(profile)
        hashes = (str(info.topic_type_hash) for info in publishers)
        return Topic(self.name, self.type_name, next(hashes, ''), offered_by(publishers))

    def _is_weaker(self, profile: Any) -> bool:
        """Whether a publisher now offers a weaker QoS than the subscription requests."""
        return bool(
            profile.reliability > self._profile.reliability
            or profile.durability > self._profile.durability
        )

    def _subscribe(self, profile: Any) -> None:
        if self._subscription is not None:
            self._node.destroy_subscription(self._subscription)
        # Without an override no incompatibility persists: see `update`.
        events = SubscriptionEventCallbacks(use_default_callbacks=self._override is not None)
        self._profile = profile
        self._subscription = self._node.create_subscription(
            self._message_type,
            self.name,
            # rclpy inspects the number of arguments of a callback.
            lambda data, info: self._receive(data, info),
            profile,
            event_callbacks=events,
            raw=True,
        )
