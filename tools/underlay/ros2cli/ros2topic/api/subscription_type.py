# SPDX-License-Identifier: Apache-2.0
"""Determine the message type of a subscription."""

from __future__ import annotations

import sys
from typing import Any

from ros2cli.messages.lookup import get_passed_type
from ros2topic.api import closest_topic, get_topic_types
from ros2topic.api.type_mismatch import type_mismatch


def resolve_type(node: Any, topic: str, name: str | None) -> Any:
    """
    Find the message class for a subscription.

    Without a name the type is read from the graph; the topic is waited for during the spin time.

    Parameters
    ----------
    node
        The `DirectNode` that will subscribe.
    topic
        Full name of the topic.
    name
        The type given by the user, if any; a warning is printed if only other types are in use.

    Raises
    ------
    RuntimeError
        The named type is invalid; or, without a name, the topic has no type yet or several.

    """
    if not name:
        return get_passed_type(_discovered_type(node, topic), 'msg')
    message_type = get_passed_type(name, 'msg')
    mismatch = type_mismatch(node.graph, topic, message_type)
    if mismatch:
        print(f'WARNING: {mismatch}', file=sys.stderr)
    return message_type


def _discovered_type(node: Any, topic: str) -> str:
    graph = node.watch.settled_with(lambda graph: get_topic_types(graph, topic))
    types = get_topic_types(graph, topic)
    if not types:
        print(f'WARNING: topic [{topic}] does not appear to be published yet')
        text = 'Could not determine the type for the passed topic'
        raise RuntimeError('\n'.join([text, closest_topic(graph, topic)]).rstrip())
    if len(types) > 1:
        raise RuntimeError(
            f"Cannot echo topic '{topic}', as it contains more than one type: [{', '.join(types)}]"
        )
    return types[0]
