# SPDX-License-Identifier: Apache-2.0
"""Subscription to one recorded topic."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rclpy.event_handler import SubscriptionEventCallbacks
from ros2bag.api.qos_profiles import offered_by
from ros2bag.storage.metadata import Topic
from ros2topic.api.qos import matching_qos

__all__ = ['RecordedTopic']


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
