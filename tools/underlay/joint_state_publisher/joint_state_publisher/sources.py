# SPDX-License-Identifier: Apache-2.0
"""The topics whose joint states are taken over."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import JointState

__all__ = ['Sources']

# Hears reliable sources and others.
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
        The topics, as they are given in the parameter.
    own_topic
        The topic on which the node itself publishes, with its full name.
    take
        Called with the full name of the topic and the message, for each message.

    Raises
    ------
    ValueError
        A name can be no topic, or is that of the node's own topic.

    """

    def __init__(self, node: Node, names: Iterable[str], own_topic: str, take: Take) -> None:
        self._take = take
        self.silent: set[str] = set()
        """The topics on which nothing was heard so far."""
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
    """Return the whole name of a topic, or raise ValueError if there can be none."""
    try:
        return str(node.resolve_topic_name(name))
    except RuntimeError as error:
        reason = str(error).split(', at ')[0].removeprefix('failed to resolve name: ')
        raise ValueError(
            f"The parameter 'source_list' names '{name}', which can be no topic: {reason}."
        ) from error
