# SPDX-License-Identifier: Apache-2.0
"""Say why no message passes between ends of a topic that have different types."""

from __future__ import annotations

from typing import Any

from ros2cli.messages.lookup import type_name
from ros2cli.node.graph import foreign_publishers, foreign_subscriptions


def type_mismatch(node: Any, topic: str, message_type: Any) -> str:
    """Return a sentence if others use a topic with other types only, or ''."""
    ends = [*foreign_publishers(node, topic), *foreign_subscriptions(node, topic)]
    types = sorted({end.topic_type for end in ends})
    name = type_name(message_type)
    if not types or name in types:
        return ''
    return f"'{topic}' has the type {', '.join(types)}, so that no {name} passes."
