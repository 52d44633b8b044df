# SPDX-License-Identifier: Apache-2.0
"""Whether anybody looks at the page, and what is left undone while nobody does."""

from __future__ import annotations

from collections.abc import Callable
import time

from rclpy.node import Node
from rviz_common.frame_listener import FrameListener
from rviz_common.polled_topic import rest_all, resume_all

__all__ = ['REST_HZ', 'Attention']

REST_HZ = 4.0
"""How often panels look around while the page is closed: a page beside it may be open."""
PATIENCE_S = 5.0
"""A page that is loaded again, or was interrupted, is back sooner."""


class Attention:
    """
    Hears what moves, such as `/tf`, only while somebody looks.

    What is heard all the time is what a page that is opened later must show at once: latched
    topics, the log, diagnostics, and whether the robot holds still.

    Parameters
    ----------
    node, listener
        The node whose polled topics rest, and the listener to transforms.
    is_watched
        Whether somebody looks now.
    may_rest
        False for a page that is to work all the time.
    clock
        Tells the time in seconds.

    """

    def __init__(
        self,
        node: Node,
        listener: FrameListener,
        is_watched: Callable[[], bool],
        may_rest: bool,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._node, self._listener = node, listener
        self._is_watched, self._may_rest, self._clock = is_watched, may_rest, clock
        self._watched_s = -PATIENCE_S
        self.rests = False

    def look(self) -> bool:
        """Begin or end to rest; return whether that has changed."""
        now_s = self._clock()
        if self._is_watched():
            self._watched_s = now_s
        before = self.rests
        self.rests = self._may_rest and now_s - self._watched_s >= PATIENCE_S
        if self.rests:
            self._listener.rest()
            rest_all(self._node)
        elif before:
            self._listener.resume()
            resume_all(self._node)
        return self.rests != before
