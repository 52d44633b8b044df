# SPDX-License-Identifier: Apache-2.0
"""Reception of one message from each of several topics."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
import time
from typing import Any, TYPE_CHECKING

from robot_console.topic_listener import TopicListener

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['Samples']

Done = Callable[[Mapping[str, Any]], None]
TIMEOUT_S = 1.5


class Samples:
    """
    Receives one message from each of several topics, with a timeout.

    Parameters
    ----------
    node
        The node that subscribes.
    full_name
        Resolves a topic name, or raises ValueError.

    """

    def __init__(self, node: Node, full_name: Callable[[str], str]) -> None:
        self._listener = TopicListener(node, full_name, lambda topic, kind: None, self._take)
        self._topics: frozenset[str] = frozenset()
        self._messages: dict[str, Any] = {}
        self._done: Done | None = None
        self._end_s = 0.0

    def ask(self, topics: Collection[str], done: Done) -> None:
        """
        Request a message from each of several topics; a pending request is dropped.

        Call `update` until `done` is called.

        Parameters
        ----------
        topics
            The names, which `full_name` resolves.
        done
            Called by `update` with the messages by topic; those not received within 1.5 s are
            missing.

        """
        self._listener.close()
        self._topics, self._done = frozenset(topics), done
        self._messages = {}
        self._end_s = time.monotonic() + TIMEOUT_S
        self._listener.listen(self._topics)

    def update(self) -> None:
        """Complete the request once all messages have arrived or the timeout has expired."""
        done = self._done
        if done is None:
            return
        self._listener.take_all()
        if len(self._messages) == len(self._topics) or time.monotonic() > self._end_s:
            self.close()
            done(self._messages)

    def close(self) -> None:
        """Cancel the request."""
        self._listener.close()
        self._done = None

    def _take(self, topic: str, message: Any, time_s: float) -> None:
        self._messages.setdefault(topic, message)
