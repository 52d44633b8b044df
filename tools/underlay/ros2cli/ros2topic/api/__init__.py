# SPDX-License-Identifier: Apache-2.0
"""Topics in the graph, and their types."""

from __future__ import annotations

from typing import Any, TYPE_CHECKING

from ros2cli.names import closest, is_hidden

if TYPE_CHECKING:
    from ros2cli.graph.graph import Graph

__all__ = [
    'closest_topic',
    'get_topic_names_and_types',
    'get_topic_types',
    'type_mismatch',
    'unknown_topic_text',
]


def get_topic_names_and_types(
    *,
    node: Any,
    include_hidden_topics: bool = False,
) -> list[tuple[str, list[str]]]:
    """
    List the topics of the graph with their types.

    Parameters
    ----------
    node
        A `Graph`, which excludes the calling node, or any other object with
        `get_topic_names_and_types`.
    include_hidden_topics
        Whether to include topics with a part that starts with an underscore.

    Returns
    -------
    list of tuple of str and list of str
        The topics that have a publisher or a subscription; those of a `Graph` are sorted.

    """
    return [
        (name, types)
        for name, types in node.get_topic_names_and_types()
        if include_hidden_topics or not is_hidden(name)
    ]


def get_topic_types(node: Any, topic: str) -> list[str]:
    """
    Return the types of a topic, hidden or not.

    Parameters
    ----------
    node
        The `Graph`.
    topic
        Full name of the topic.

    Returns
    -------
    list of str
        The types; empty if the topic has neither a publisher nor a subscription.

    """
    return dict(get_topic_names_and_types(node=node, include_hidden_topics=True)).get(topic, [])


def unknown_topic_text(node: Any, topic: str) -> str:
    """
    Format the error message for an unknown topic, with a suggestion if a name is close.

    Parameters
    ----------
    node
        The `Graph`.
    topic
        The topic as the user wrote it.

    """
    return '\n'.join([f"Unknown topic '{topic}'", closest_topic(node, topic)]).rstrip()


def closest_topic(node: Any, topic: str) -> str:
    """
    Suggest the known topic that is closest to a name.

    Parameters
    ----------
    node
        The `Graph`.
    topic
        The topic as the user wrote it; it does not count as known.

    Returns
    -------
    str
        A question such as `Did you mean '/chatter'?`, or '' if no name is close.

    """
    known = [name for name, _ in get_topic_names_and_types(node=node)]
    return closest(topic, [name for name in known if name != topic])


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
    from ros2cli.messages.lookup import type_name

    types = get_topic_types(graph, topic)
    name = type_name(message_type)
    if not types or name in types:
        return ''
    return f"'{topic}' has the type {', '.join(types)}, not {name}."
