# SPDX-License-Identifier: Apache-2.0
"""The transforms that are published on the topics `tf` and `tf_static`."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from typing import Any, NamedTuple

TRANSFORM_TYPE = 'tf2_msgs/msg/TFMessage'
STATIC_SUFFIX = '_static'
DEPTH = 100


class Transform(NamedTuple):
    """
    An edge in a tree of frames.

    :param tree: the topic of moving transforms, to which the static ones of its name belong
    """

    tree: str
    parent: str
    child: str


class TransformListener:
    """
    Listener that collects the transforms of all transform topics.

    Parameters
    ----------
    node
        The `DirectNode` that subscribes, once `listen_to` has been called.

    Attributes
    ----------
    transforms
        The edges received so far.

    """

    def __init__(self, node: Any) -> None:
        self.transforms: set[Transform] = set()
        self._node = node
        self._subscriptions: list[Any] = []

    @property
    def is_listening(self) -> bool:
        """Whether there is any topic to listen to."""
        return bool(self._subscriptions)

    def listen_to(self, types: Mapping[str, str]) -> None:
        """
        Subscribe to the topics that carry transforms, if tf2_msgs is installed.

        Parameters
        ----------
        types
            The name of the type of each topic, such as `tf2_msgs/msg/TFMessage`.

        """
        topics = [topic for topic, name in types.items() if name == TRANSFORM_TYPE]
        if not topics:
            return
        try:
            message_type = import_module('tf2_msgs.msg').TFMessage
        except ImportError:
            return
        self._subscriptions = [self._subscribe(message_type, topic) for topic in topics]

    def _subscribe(self, message_type: Any, topic: str) -> Any:
        from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

        is_static = topic.endswith(STATIC_SUFFIX)
        profile = QoSProfile(
            depth=DEPTH,
            reliability=ReliabilityPolicy.RELIABLE if is_static else ReliabilityPolicy.BEST_EFFORT,
            durability=DurabilityPolicy.TRANSIENT_LOCAL
            if is_static
            else DurabilityPolicy.VOLATILE,
        )
        tree = topic.removesuffix(STATIC_SUFFIX)

        def receive(message: Any) -> None:
            for each in message.transforms:
                edge = Transform(tree, each.header.frame_id, each.child_frame_id)
                self.transforms.add(edge)

        return self._node.create_subscription(message_type, topic, receive, profile)
