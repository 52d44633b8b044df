# SPDX-License-Identifier: Apache-2.0
"""Names of topics of one of several robots."""

from __future__ import annotations

from dataclasses import dataclass
import re
from typing import Any, TYPE_CHECKING

from rviz_common.properties import Text
from rviz_common.topic_names import full_topic_name

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['NAMESPACE', 'Namespace', 'below', 'topic_of_robot']

VALID = re.compile(r'(/?[A-Za-z_][A-Za-z0-9_]*)*/?')


@dataclass(frozen=True)
class Namespace(Text):
    """The namespace of a robot."""

    def read(self, value: Any) -> str:
        """Return the value, or raise ValueError."""
        text = super().read(value)
        if not VALID.fullmatch(text):
            raise ValueError(f"must be like 'robot1', and not '{text}'")
        return text.strip('/')


NAMESPACE = Namespace('Namespace', '', 'The robot; it is put before the names of topics.')


def below(namespace: str, topic: str) -> str:
    """Return a topic in a namespace; those that begin with a slash stay as they are."""
    if topic.startswith('/') or not namespace:
        return topic
    return f'/{namespace}/{topic}'


def topic_of_robot(node: Node, namespace: str, topic: str) -> str:
    """Return the full name of a topic of a robot, or raise ValueError if it is no name."""
    return full_topic_name(node, below(namespace, topic))
