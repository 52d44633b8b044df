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
        """
        Validate a namespace that a file or a widget gives.

        Parameters
        ----------
        value
            Anything that becomes a text; None stands for no namespace.

        Returns
        -------
        str
            The namespace without slashes at its ends.

        Raises
        ------
        ValueError
            It is no valid namespace; the text goes on after the name of the property.

        """
        text = super().read(value)
        if not VALID.fullmatch(text):
            raise ValueError(f"must be like 'robot1', and not '{text}'")
        return text.strip('/')


NAMESPACE = Namespace('Namespace', '', 'The robot; it is put before the names of topics.')


def below(namespace: str, topic: str) -> str:
    """
    Put a relative topic name into the namespace of a robot.

    Parameters
    ----------
    namespace
        Without slashes at its ends; '' leaves the name as it is.
    topic
        The name; an absolute one, with a leading slash, stays as it is.

    """
    if topic.startswith('/') or not namespace:
        return topic
    return f'/{namespace}/{topic}'


def topic_of_robot(node: Node, namespace: str, topic: str) -> str:
    """
    Resolve the topic name of a robot to a fully qualified one.

    Parameters
    ----------
    node
        The node whose remappings apply, and whose namespace if there is no other.
    namespace, topic
        As for `below`.

    Raises
    ------
    ValueError
        It is no valid topic name; the text is a sentence.

    """
    return full_topic_name(node, below(namespace, topic))
