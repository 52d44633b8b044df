# SPDX-License-Identifier: Apache-2.0
"""Subscriptions to the source topics of joint states."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import JointState

__all__ = ['Sources']

# Best effort is compatible with reliable and best-effort publishers.
ANY = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
Take = Callable[[str, JointState], None]


class Sources:
    """
    Subscriptions to the topics of `source_list`.

    Parameters
    ----------
    node
        The node that subscribes.
    names
        The topics, as given in the parameter.
    own_topic
        The fully qualified name of the topic on which the node itself publishes.
    take
        Called for each message with the fully qualified topic name and the message.

    Raises
    ------
    ValueError
        A name is not a valid topic name, or is that of the node's own topic.

    """

    def __init__(self, node: Node, names: Iterable[str], own_topic: str, take: Take) -> None:
        self._take = take
        self.silent: set[str] = set()
        """The topics on which no message has been received yet."""
        for name in names:
            topic = _resolved(node, name)
            if topic == own_topic:
                raise ValueError(
                    f"The parameter 'source_list' names {topic}, which is what this node "
                    'publishes. Name another topic, or remap joint_states.'
                )
            self.silent.add(topic)
            node.create_subscription(JointState, name, self._receiver(topic), ANY)

    def _receiver(self, topic: str) -> Callable[[JointState], None]:
        """Return the callback for the messages of a topic."""

        def receive(message: JointState) -> None:
            self.silent.discard(topic)
            self._take(topic, message)

        return receive


def _resolved(node: Node, name: str) -> str:
    """Return the fully qualified name of a topic, or raise ValueError if the name is invalid."""
    try:
        return str(node.resolve_topic_name(name))
    except RuntimeError as error:
        reason = str(error).split(', at ')[0].removeprefix('failed to resolve name: ')
        raise ValueError(
            f"The parameter 'source_list' names '{name}', which can be no topic: {reason}."
        ) from error
