# SPDX-License-Identifier: Apache-2.0
"""Detection of endpoints of a topic with different types."""

from __future__ import annotations

from typing import Any, TYPE_CHECKING

from ros2cli.messages.lookup import type_name
from ros2topic.api import get_topic_types

if TYPE_CHECKING:
    from ros2cli.graph.graph import Graph


def type_mismatch(graph: Graph, topic: str, message_type: Any) -> str:
    """
    Check whether a topic is only used with types other than one's own.

    Parameters
    ----------
    graph
        The graph, which does not contain the calling node.
    topic
        Full name of the topic.
    message_type
        The class of one's own messages.

    Returns
    -------
    str
        The message, or '' if the topic is used with this type or not at all.

    """
    types = get_topic_types(graph, topic)
    name = type_name(message_type)
    if not types or name in types:
        return ''
    return f"'{topic}' has the type {', '.join(types)}, so that no {name} passes."
