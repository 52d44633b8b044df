# SPDX-License-Identifier: Apache-2.0
"""When frames are drawn: at the frame rate, and hardly ever while no page is open."""

from __future__ import annotations

from collections.abc import Callable
import time

from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rviz_common.frames import FrameListener
from rviz_common.polled_topic import rest_all, resume_all

__all__ = ['REST_HZ', 'Attention', 'FrameLoop']

FASTEST_HZ = 60.0

REST_HZ = 4.0
"""The update rate of panels while the page is closed: one of their own pages may be open."""
PATIENCE_S = 5.0
"""The delay in s before resting; a page that is reloaded or interrupted is back sooner."""


class FrameLoop:
    """
    Timer that calls a function for each frame, in the node's thread.

    The clock is steady, so that frames continue while a simulator is paused.

    Parameters
    ----------
    node
        The node that spins the timer.
    frame
        Draws a frame.
    rate_hz
        The frame rate, limited to 1 to 60 Hz.

    """

    def __init__(self, node: Node, frame: Callable[[], None], rate_hz: float) -> None:
        self._node = node
        self._frame = frame
        self._clock = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = node.create_timer(_period_s(rate_hz), frame, clock=self._clock)

    def set_rate(self, rate_hz: float) -> None:
        """
        Change the frame rate.

        Parameters
        ----------
        rate_hz
            The frame rate, limited to 1 to 60 Hz.

        """
        period_ns = int(_period_s(rate_hz) * 1e9)
        if period_ns != self._timer.timer_period_ns:
            self._timer.timer_period_ns = period_ns
            self._timer.reset()

    def close(self) -> None:
        """Stop drawing frames."""
        self._node.destroy_timer(self._timer)


def _period_s(rate_hz: float) -> float:
    return 1.0 / min(max(rate_hz, 1.0), FASTEST_HZ)


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
