# SPDX-License-Identifier: Apache-2.0
"""The frame timer, in the thread of a node."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from rclpy.clock import Clock, ClockType

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['FrameLoop']

FASTEST_HZ = 60.0


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
