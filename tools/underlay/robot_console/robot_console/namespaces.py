# SPDX-License-Identifier: Apache-2.0
"""Topic names in the namespace of a robot."""

from __future__ import annotations

from dataclasses import dataclass
import re
from typing import Any, TYPE_CHECKING

from rviz_common.properties import Text
from rviz_common.topics import full_topic_name

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['NAMESPACE', 'Namespace', 'below', 'topic_of_robot']

VALID = re.compile(r'(/?[A-Za-z_][A-Za-z0-9_]*)*/?')


@dataclass(frozen=True)
class Namespace(Text):
    """Property for the namespace of a robot."""

    def read(self, value: Any) -> str:
        """
        Validate a namespace from a file or a widget.

        Parameters
        ----------
        value
            Any value that can be converted to a string; None stands for no namespace.

        Returns
        -------
        str
            The namespace without leading and trailing slashes.

        Raises
        ------
        ValueError
            The namespace is invalid; the message continues after the name of the property.

        """
        text = super().read(value)
        if not VALID.fullmatch(text):
            raise ValueError(f"must be like 'robot1', not '{text}'")
        return text.strip('/')


NAMESPACE = Namespace('Namespace', '', 'Namespace of the robot; prefix of the topic names.')


def below(namespace: str, topic: str) -> str:
    """
    Place a relative topic name in the namespace of a robot.

    Parameters
    ----------
    namespace
        Without leading and trailing slashes; '' leaves the name unchanged.
    topic
        The name; an absolute name, with a leading slash, is unchanged.

    """
    if topic.startswith('/') or not namespace:
        return topic
    return f'/{namespace}/{topic}'


def topic_of_robot(node: Node, namespace: str, topic: str) -> str:
    """
    Resolve the topic name of a robot to a fully qualified name.

    Parameters
    ----------
    node
        The node whose remappings apply, and whose namespace is the default.
    namespace, topic
        As for `below`.

    Raises
    ------
    ValueError
        The name is not a valid topic name; the message is a full sentence.

    """
    return full_topic_name(node, below(namespace, topic))
