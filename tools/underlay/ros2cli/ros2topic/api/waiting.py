# SPDX-License-Identifier: Apache-2.0
"""Wait for a topic and all of its ends."""

from __future__ import annotations

import time
from typing import Any

from ros2cli.node.graph import take_snapshot
from ros2topic.api import get_topic_types

PERIOD_S = 0.02
SETTLE_S = 0.1
LONGEST_S = 1.0


def find_types(node: Any, topic: str) -> list[str]:
    """Return the types of a topic soon after it is discovered; none if it does not exist."""
    node.wait_for_graph(lambda: get_topic_types(node, topic))
    settle(node)
    return get_topic_types(node, topic)


def settle(node: Any) -> None:
    """Wait a moment, after all nodes are known, in which more ends of a topic may be found."""
    start = time.monotonic()
    end = start + SETTLE_S
    while time.monotonic() < end:
        node.spin_once(PERIOD_S)
        if take_snapshot(node).is_complete is False:
            end = min(time.monotonic(), start + LONGEST_S) + SETTLE_S
