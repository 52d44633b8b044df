# SPDX-License-Identifier: Apache-2.0
"""Saving CPU time while no page is open."""

from __future__ import annotations

from collections.abc import Callable
import time

from rclpy.node import Node
from rviz_common.frame_listener import FrameListener
from rviz_common.polled_topic import rest_all, resume_all

__all__ = ['REST_HZ', 'Attention']

REST_HZ = 4.0
"""The update rate of panels while the page is closed: one of their own pages may be open."""
PATIENCE_S = 5.0
"""The delay in s before resting; a page that is reloaded or interrupted is back sooner."""


class Attention:
    """
    Subscribes to streams of data, such as `/tf`, only while a page is open.

    Topics that a page must show immediately when it is opened later stay subscribed: latched
    topics, the log, diagnostics, and whether the robot holds still.

    Parameters
    ----------
    node, listener
        The node whose polled topics rest, and the transform listener.
    is_watched
        Returns whether a page is open now.
    may_rest
        False for a page that is to work all the time.
    clock
        Returns the time in seconds.

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
        """Start or stop resting; return whether that has changed."""
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
