# SPDX-License-Identifier: Apache-2.0
"""Wait for a topic and its publishers."""

from __future__ import annotations

import time
from typing import Any

from ros2cli.node.graph import foreign_publishers
from ros2topic.api import get_topic_types

PERIOD_S = 0.02
SETTLE_S = 0.1


def find_types(node: Any, topic: str) -> list[str]:
    """Return the types of a topic as soon as it is discovered; none if it does not exist."""
    node.wait_for_graph(lambda: get_topic_types(node, topic))
    return get_topic_types(node, topic)


def settled_publishers(node: Any, topic: str) -> list[Any]:
    """Return the publishers of a topic, after a moment in which more may be discovered."""
    end = time.monotonic() + SETTLE_S
    while time.monotonic() < end:
        node.spin_once(PERIOD_S)
    return foreign_publishers(node, topic)
