# SPDX-License-Identifier: Apache-2.0
"""Wait for a topic and its publishers."""

from __future__ import annotations

import re
import sys
import time
from typing import Any

from ros2cli.node.graph import foreign_publishers
from ros2topic.api import get_topic_types

PERIOD_S = 0.02
SETTLE_S = 0.1
PATIENCE_S = 2.0
TOPIC_NAME = re.compile(r'(/[A-Za-z_][A-Za-z0-9_]*)+')


def absolute(topic: str) -> str:
    """Return a topic's name with the leading slash that users leave out, if it is a name."""
    name = topic if topic.startswith('/') else f'/{topic}'
    if not TOPIC_NAME.fullmatch(name):
        raise RuntimeError(
            f"'{topic}' is no name of a topic: parts of letters, digits and underscores, none of "
            "which begins with a digit, joined by slashes, as in '/robot1/joint_commands'"
        )
    return name


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


class Patience:
    """Says once on stderr what a command waits for, when it has been waiting for a while."""

    def __init__(self, what: str) -> None:
        """Start the wait."""
        self._what = what
        self._end = time.monotonic() + PATIENCE_S

    def check(self) -> None:
        """Speak up if the time has come."""
        if time.monotonic() > self._end:
            print(f'Still waiting for {self._what} (Ctrl-C to stop)', file=sys.stderr)
            self._end = float('inf')
