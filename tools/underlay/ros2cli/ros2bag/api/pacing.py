# SPDX-License-Identifier: Apache-2.0
"""Pacing of playback: mapping of wall time to recorded time, and its publication on /clock."""

from __future__ import annotations

from collections.abc import Callable, Collection
import time
from typing import Any

from ros2bag.storage.latched import RecordedMessage

__all__ = ['CLOCK_TOPIC', 'ClockOutlet', 'Pacing']

CLOCK_TOPIC = '/clock'
NS_PER_S = 1_000_000_000
NEVER_NS = 2**63 - 1


class Pacing:
    """
    Mapping of wall time to recorded time, from now on, at a playback rate.

    Parameters
    ----------
    recorded_ns
        The recorded time that corresponds to now, in ns since the epoch.
    rate
        Recorded seconds per second; may be infinite.
    now_ns
        A monotonic clock, in ns.

    Attributes
    ----------
    changes
        How often the recorded time or the rate was changed.

    """

    def __init__(
        self, recorded_ns: int, rate: float, now_ns: Callable[[], int] = time.monotonic_ns
    ) -> None:
        self._now_ns = now_ns
        self._rate = rate
        self._anchor_recorded_ns = recorded_ns
        self._anchor_ns = now_ns()
        self._is_held = False
        self.changes = 0

    @property
    def rate(self) -> float:
        """Return the playback rate, in recorded seconds per second."""
        return self._rate

    @property
    def recorded_now_ns(self) -> int:
        """Return the recorded time that corresponds to now."""
        if self._is_held or self._rate == float('inf'):
            return self._anchor_recorded_ns
        elapsed_ns = self._now_ns() - self._anchor_ns
        return self._anchor_recorded_ns + int(elapsed_ns * self._rate)

    def wait_ns(self, recorded_ns: int) -> int:
        """
        Compute the wall time until a recorded time is due; invalid while time is held.

        Parameters
        ----------
        recorded_ns
            In ns since the epoch.

        Returns
        -------
        int
            In ns of wall time; negative if it is overdue.

        """
        due_ns = self._anchor_ns + int((recorded_ns - self._anchor_recorded_ns) / self._rate)
        return due_ns - self._now_ns()

    def start_in(self, delay_ns: int) -> None:
        """
        Reach the recorded time that was given at first later than now.

        Parameters
        ----------
        delay_ns
            How much later, in ns of wall time.

        """
        self._anchor_ns = self._now_ns() + delay_ns

    def hold(self) -> None:
        """Pause the recorded time."""
        if not self._is_held:
            self._anchor_recorded_ns = self.recorded_now_ns
            self._is_held = True

    def release(self) -> None:
        """Resume the recorded time."""
        if self._is_held:
            self._is_held = False
            self._anchor_ns = self._now_ns()

    def jump_to(self, recorded_ns: int) -> None:
        """
        Continue from another recorded time.

        Parameters
        ----------
        recorded_ns
            The recorded time that corresponds to now, in ns since the epoch.

        """
        self._anchor_recorded_ns = recorded_ns
        self._anchor_ns = self._now_ns()
        self.changes += 1

    def set_rate(self, rate: float) -> None:
        """
        Continue at another playback rate.

        Parameters
        ----------
        rate
            Recorded seconds per second; may be infinite.

        """
        self.jump_to(self.recorded_now_ns)
        self._rate = rate


class ClockOutlet:
    """
    Publishes the recorded time: at a fixed rate, also while playback is paused, or with messages.

    Parameters
    ----------
    node
        The node that publishes it.
    topic
        The name of the topic, which is `/clock` unless it is remapped.
    rate_hz
        How often to publish, in Hz of wall time; 0 for only with messages.
    triggers
        The topics before each of whose messages the time is published.

    Attributes
    ----------
    publisher
        The publisher of rosgraph_msgs/msg/Clock.

    """

    def __init__(
        self, node: Any, topic: str, rate_hz: float, triggers: Collection[str] = ()
    ) -> None:
        from rosgraph_msgs.msg import Clock

        self._clock = Clock()
        self.publisher = node.create_publisher(Clock, topic, 10)
        self._period_ns = int(NS_PER_S / rate_hz) if rate_hz else NEVER_NS
        self._triggers = frozenset(triggers)
        self._next_ns = 0

    def tick(self, pacing: Pacing, next_ns: int) -> int:
        """
        Publish the recorded time if it is due.

        Parameters
        ----------
        pacing
            The mapping of wall time to recorded time.
        next_ns
            The recorded time of the message to play next, in ns since the epoch. The published
            time does not pass it, however late the player is.

        Returns
        -------
        int
            The time until the next publication is due, in ns of wall time.

        """
        now_ns = time.monotonic_ns()
        if self._period_ns == NEVER_NS:
            return NEVER_NS
        if now_ns >= self._next_ns:
            self.publish(min(pacing.recorded_now_ns, next_ns))
            self._next_ns = max(self._next_ns + self._period_ns, now_ns)
        return self._next_ns - now_ns

    def announce(self, message: RecordedMessage) -> None:
        """
        Publish the recorded time of a message that is played next, if its topic asks for it.

        Parameters
        ----------
        message
            The message.

        """
        if message.topic in self._triggers:
            self.publish(message.log_ns)

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
