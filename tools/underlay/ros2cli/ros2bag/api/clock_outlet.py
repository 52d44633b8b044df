# SPDX-License-Identifier: Apache-2.0
"""Publisher of the recorded time, on /clock unless it is remapped."""

from __future__ import annotations

import time
from typing import Any

from ros2bag.api.pacing import Pacing

__all__ = ['CLOCK_TOPIC', 'ClockOutlet']

CLOCK_TOPIC = '/clock'
NS_PER_S = 1_000_000_000


class ClockOutlet:
    """
    Publishes the recorded time at a fixed rate, also while playback is paused.

    Parameters
    ----------
    node
        The node that publishes it.
    topic
        The name of the topic, which is `/clock` unless it is remapped.
    rate_hz
        How often to publish, in Hz of wall time.

    Attributes
    ----------
    publisher
        The publisher of rosgraph_msgs/msg/Clock.

    """

    def __init__(self, node: Any, topic: str, rate_hz: float) -> None:
        from rosgraph_msgs.msg import Clock

        self._clock = Clock()
        self.publisher = node.create_publisher(Clock, topic, 10)
        self._period_ns = int(NS_PER_S / rate_hz)
        self._next_ns = 0

    def tick(self, pacing: Pacing) -> int:
        """
        Publish the recorded time if it is due.

        Parameters
        ----------
        pacing
            The mapping of wall time to recorded time.

        Returns
        -------
        int
            The time until the next publication is due, in ns of wall time.

        """
        now_ns = time.monotonic_ns()
        if now_ns >= self._next_ns:
            self.publish(pacing.recorded_now_ns)
            self._next_ns = max(self._next_ns + self._period_ns, now_ns)
        return self._next_ns - now_ns

    def publish(self, recorded_ns: int) -> None:
        """
        Publish a time.

        Parameters
        ----------
        recorded_ns
            Nanoseconds since the epoch; a negative time is published as zero.

        """
        stamp = self._clock.clock
        stamp.sec, stamp.nanosec = divmod(max(0, recorded_ns), NS_PER_S)
        self.publisher.publish(self._clock)
