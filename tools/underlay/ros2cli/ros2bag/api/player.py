# SPDX-License-Identifier: Apache-2.0
"""Publish recorded messages when they are due, while keys and services control the playback."""

from __future__ import annotations

from collections.abc import Callable, Iterator
import time
from typing import Any

from ros2bag.api.control import DOWN, Keyboard, PauseSwitch, RIGHT, SPACE, UP
from ros2bag.api.outlets import Outlets
from ros2bag.api.pacing import ClockOutlet, Pacing
from ros2bag.storage.latched import RecordedMessage

__all__ = ['PlayHead', 'Player']

STEP_NS = 50_000_000
# The executor is not spun shortly before a message is due: a plain sleep ends on time.
EXACT_NS = 3_000_000
FASTER = 1.1


class PlayHead:
    """
    Position in a bag: the message to play next.

    Parameters
    ----------
    messages_from
        Returns the messages from a time on, in ns since the epoch.
    start_ns
        The time to start from.
    limit
        How many messages to play in one pass; None for all.

    """

    def __init__(
        self,
        messages_from: Callable[[int], Iterator[RecordedMessage]],
        start_ns: int,
        limit: int | None = None,
    ) -> None:
        self._messages_from, self._limit = messages_from, limit
        self.seek(start_ns)

    def seek(self, time_ns: int) -> None:
        """
        Go to a time.

        Parameters
        ----------
        time_ns
            In ns since the epoch; the next message is the first one that is not before it.

        """
        self._messages = self._messages_from(time_ns)
        self._next: RecordedMessage | None = None
        self._left = float('inf') if self._limit is None else self._limit

    def peek(self) -> RecordedMessage | None:
        """Return the message to play next; None at the end."""
        if self._next is None and self._left > 0:
            self._next = next(self._messages, None)
        return self._next

    def pop(self) -> RecordedMessage | None:
        """Return the message to play next, and go on to the one after it; None at the end."""
        message = self.peek()
        self._next = None
        self._left -= message is not None
        return message


class Player:
    """
    Publisher of recorded messages at their due times; serves keyboard and services meanwhile.

    Parameters
    ----------
    node
        The node to spin.
    outlets
        The publishers.
    clock
        The publisher of the recorded time, or None.
    switch
        The paused state, which SPACE toggles.
    keyboard
        The source of keys: RIGHT plays the next message while paused, UP and DOWN change the rate.
    head
        The position in the bag.
    pacing
        The due times of recorded messages.

    Attributes
    ----------
    count
        How many messages are published.

    """

    def __init__(
        self,
        node: Any,
        outlets: Outlets,
        clock: ClockOutlet | None,
        switch: PauseSwitch,
        keyboard: Keyboard,
        head: PlayHead,
        pacing: Pacing,
    ) -> None:
        self._node = node
        self._outlets = outlets
        self._clock = clock
        self._switch = switch
        self._keyboard = keyboard
        self._head = head
        self.pacing = pacing
        self._served_ns = 0
        self._is_stopped = False
        self.count = 0

    def play(self) -> bool:
        """
        Publish messages, each when it is due, until the bag ends or `stop` is called.

        Returns
        -------
        bool
            Whether the bag has ended.

        """
        while not self._is_stopped:
            message = self._head.peek()
            if message is None:
                return True
            if self._is_due(message.log_ns):
                self._publish_next()
        return False

    def rest_until(self, recorded_ns: int) -> None:
        """
        Wait for a recorded time without publishing a message, unless one is asked for.

        Parameters
        ----------
        recorded_ns
            In ns since the epoch.

        """
        while not self._is_stopped and not self._is_due(recorded_ns):
            pass

    def play_next(self, count: int = 1) -> int:
        """
        Publish the next messages at once; only while paused.

        Parameters
        ----------
        count
            How many; 0 for all that are left.

        Returns
        -------
        int
            How many there were; 0 unless paused.

        """
        played = 0
        while self._switch.is_paused and (played < count or not count):
            message = self._head.peek()
            if message is None:
                break
            self.pacing.hold()
            self.pacing.jump_to(message.log_ns)
            self._publish_next()
            played += 1
        return played

    def seek(self, time_ns: int) -> None:
        """
        Go on from another recorded time.

        Parameters
        ----------
        time_ns
            In ns since the epoch.

        """
        self._head.seek(time_ns)
        self.pacing.jump_to(time_ns)

    def stop(self) -> None:
        """End the playback."""
        self._is_stopped = True

    def _publish_next(self) -> None:
        message = self._head.pop()
        if message is not None:
            if self._clock is not None:
                self._clock.announce(message)
            self._outlets.publish(message.topic, message.data)
            self.count += 1

    def _is_due(self, recorded_ns: int) -> bool:
        """Whether a recorded time has come; if not, wait a little for it."""
        left_ns = min(self.pacing.wait_ns(recorded_ns), STEP_NS)
        if left_ns > 0 or self._switch.is_paused or self._is_service_due():
            before = self.pacing.changes
            self._serve_others(recorded_ns)
            if self.pacing.changes != before or self._is_stopped:
                return False
        if self._switch.is_paused:
            self.pacing.hold()
            left_ns = STEP_NS
        else:
            self.pacing.release()
            left_ns = min(self.pacing.wait_ns(recorded_ns), STEP_NS)
            if left_ns <= 0:
                return True
        self._idle(left_ns, recorded_ns)
        return False

    def _idle(self, left_ns: int, next_ns: int) -> None:
        """Spin or sleep for the remaining time, at most until the clock is due."""
        if self._clock is not None:
            left_ns = min(left_ns, self._clock.tick(self.pacing, next_ns))
        if left_ns > EXACT_NS:
            self._node.spin_once((left_ns - EXACT_NS) / 1e9)
        elif left_ns > 0:
            time.sleep(left_ns / 1e9)

    def _is_service_due(self) -> bool:
        """Whether the keyboard and services are overdue because messages are dense."""
        return time.monotonic_ns() - self._served_ns > STEP_NS

    def _serve_others(self, next_ns: int) -> None:
        now_ns = time.monotonic_ns()
        if now_ns - self._served_ns < STEP_NS / 2:
            return
        self._served_ns = now_ns
        self._node.spin_once(0.0)
        if self._clock is not None:
            self._clock.tick(self.pacing, next_ns)
        self._obey(self._keyboard.pressed())

    def _obey(self, keys: str) -> None:
        if SPACE in keys:
            self._switch.toggle()
        if RIGHT in keys:
            self.play_next(keys.count(RIGHT))
        steps = keys.count(UP) - keys.count(DOWN)
        if steps:
            self.pacing.set_rate(self.pacing.rate * FASTER**steps)
            self._node.get_logger().info(f'Rate: {self.pacing.rate:.3g}')
