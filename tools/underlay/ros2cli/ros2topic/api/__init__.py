# SPDX-License-Identifier: Apache-2.0
"""The topics of the graph."""

from __future__ import annotations

from typing import Any

from ros2cli.names import closest, is_hidden

__all__ = ['closest_topic', 'get_topic_names_and_types', 'get_topic_types', 'unknown_topic_text']


def get_topic_names_and_types(
    *,
    node: Any,
    include_hidden_topics: bool = False,
) -> list[tuple[str, list[str]]]:
    """Return the topics that others publish or subscribe to, sorted, with their types."""
    return [
        (name, types)
        for name, types in node.get_topic_names_and_types()
        if include_hidden_topics or not is_hidden(name)
    ]


def get_topic_types(node: Any, topic: str) -> list[str]:
    """Return the types of one topic, hidden or not; none if nobody uses it."""
    return dict(get_topic_names_and_types(node=node, include_hidden_topics=True)).get(topic, [])


def unknown_topic_text(node: Any, topic: str) -> str:
    """Return the error text for an unknown topic, with a name that comes close."""
    return '\n'.join([f"Unknown topic '{topic}'", closest_topic(node, topic)]).rstrip()


def closest_topic(node: Any, topic: str) -> str:
    """Return a question that names the topic which is meant, or '' if none is close."""
    known = [name for name, _ in get_topic_names_and_types(node=node)]
    return closest(topic, [name for name in known if name != topic])
