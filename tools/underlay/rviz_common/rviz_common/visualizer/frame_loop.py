# SPDX-License-Identifier: Apache-2.0
"""When frames are drawn and inputs handled: at the frame rate, and hardly ever without a page."""

from __future__ import annotations

from collections.abc import Callable
import time

from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.timer import Timer
from rviz_common.frames import FrameListener
from rviz_common.inputs import WorkQueue
from rviz_common.polled_topic import rest_all, resume_all
from rviz_common.status import described_error

__all__ = ['Attention', 'FrameLoop']

FASTEST_HZ = 60.0

REST_HZ = 4.0
"""The update rate of panels while the page is closed: one of their own pages may be open."""
PATIENCE_S = 5.0
"""The delay in s before resting; a page that is reloaded or interrupted is back sooner."""


class FrameLoop:
    """
    Draws frames, and runs the work that widgets post, in the node's thread.

    The clock is steady, so that frames continue while a simulator is paused.

    Parameters
    ----------
    node
        The node that spins.
    frame
        Draws a frame.
    attention
        Decides when to rest.

    Attributes
    ----------
    queue
        The work that widgets post; it is run soon.

    """

    def __init__(self, node: Node, frame: Callable[[], None], attention: Attention) -> None:
        self._node, self._frame, self._attention = node, frame, attention
        self._logger = node.get_logger()
        self._clock = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer: Timer | None = None
        self._rate_hz = REST_HZ
        self._is_closed = False
        self.queue = WorkQueue(self.rouse)

    @property
    def rests(self) -> bool:
        """Whether no page is open, so that hardly any frames are drawn."""
        return self._attention.rests

    def set_rate(self, rate_hz: float) -> None:
        """
        Draw frames at a rate from now on, except while resting.

        Parameters
        ----------
        rate_hz
            The frame rate, limited to 1 to 60 Hz.

        """
        self._rate_hz = rate_hz
        period_s = _period_s(REST_HZ if self.rests else rate_hz)
        if self._timer is None:
            self._timer = self._node.create_timer(period_s, self._frame, clock=self._clock)
        elif int(period_s * 1e9) != self._timer.timer_period_ns:
            self._timer.timer_period_ns = int(period_s * 1e9)
            self._timer.reset()

    def attend(self) -> None:
        """Rest while no page is open, and resume when one is opened."""
        if self._attention.look():
            self.set_rate(self._rate_hz)

    def rouse(self) -> None:
        """Schedule posted work to run soon; a browser may post until the page is closed."""
        executor = self._node.executor
        if executor is not None and not self._is_closed:
            executor.create_task(self._work)

    def close(self) -> None:
        """Stop drawing frames and running work."""
        self._is_closed = True
        if self._timer is not None:
            self._node.destroy_timer(self._timer)

    def _work(self) -> None:
        """Run the work that widgets have posted."""
        try:
            self.attend()
            self.queue.run()
        except Exception as error:  # a failing widget must not stop anything else
            self._logger.error(f'An input could not be handled: {described_error(error)}')
            self.rouse()  # for the remaining work


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
