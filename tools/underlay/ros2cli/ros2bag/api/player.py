# SPDX-License-Identifier: Apache-2.0
"""Playback of recorded messages at their due times."""

from __future__ import annotations

from collections.abc import Iterable
import time
from typing import Any

from ros2bag.api.clock_outlet import ClockOutlet
from ros2bag.api.keyboard import DOWN, Keyboard, RIGHT, SPACE, UP
from ros2bag.api.outlets import Outlets
from ros2bag.api.pacing import Pacing
from ros2bag.api.pause import PauseSwitch
from ros2bag.storage.latched import RecordedMessage

__all__ = ['Player']

STEP_NS = 50_000_000
# The executor is not spun shortly before a message is due: a plain sleep ends on time.
EXACT_NS = 3_000_000
FASTER = 1.1


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

    """

    def __init__(
        self,
        node: Any,
        outlets: Outlets,
        clock: ClockOutlet | None,
        switch: PauseSwitch,
        keyboard: Keyboard,
    ) -> None:
        self._node = node
        self._outlets = outlets
        self._clock = clock
        self._switch = switch
        self._keyboard = keyboard
        self._next_is_wanted = False
        self._served_ns = 0

    def play(self, messages: Iterable[RecordedMessage], pacing: Pacing) -> int:
        """
        Publish messages, each when it is due.

        Parameters
        ----------
        messages
            In publication order; all of their topics must be among the outlets.
        pacing
            The due times of recorded messages; pausing and keys change them.

        Returns
        -------
        int
            The number of published messages.

        """
        count = 0
        for message in messages:
            self._wait_until(message.log_ns, pacing)
            self._outlets.publish(message.topic, message.data)
            count += 1
        return count

    def rest_until(self, recorded_ns: int, pacing: Pacing) -> None:
        """
        Wait for a recorded time without publishing a message.

        Parameters
        ----------
        recorded_ns
            In ns since the epoch.
        pacing
            The due times, as for `play`.

        """
        self._wait_until(recorded_ns, pacing)

    def _wait_until(self, recorded_ns: int, pacing: Pacing) -> None:
        while True:
            left_ns = min(pacing.wait_ns(recorded_ns), STEP_NS)
            if left_ns > 0 or self._switch.is_paused or self._is_service_due():
                self._serve_others(pacing)
            if self._switch.is_paused:
                pacing.hold()
                if self._take_next_wish():
                    pacing.jump_to(recorded_ns)
                    return
                left_ns = STEP_NS
            else:
                pacing.release()
                left_ns = min(pacing.wait_ns(recorded_ns), STEP_NS)
                if left_ns <= 0:
                    return
            self._idle(left_ns, pacing)

    def _idle(self, left_ns: int, pacing: Pacing) -> None:
        """Spin or sleep for the remaining time, at most until the clock is due."""
        if self._clock is not None:
            left_ns = min(left_ns, self._clock.tick(pacing))
        if left_ns > EXACT_NS:
            self._node.spin_once((left_ns - EXACT_NS) / 1e9)
        elif left_ns > 0:
            time.sleep(left_ns / 1e9)

    def _is_service_due(self) -> bool:
        """Whether the keyboard and services are overdue because messages are dense."""
        return time.monotonic_ns() - self._served_ns > STEP_NS

    def _serve_others(self, pacing: Pacing) -> None:
        now_ns = time.monotonic_ns()
        if now_ns - self._served_ns < STEP_NS / 2:
            return
        self._served_ns = now_ns
        self._node.spin_once(0.0)
        if self._clock is not None:
            self._clock.tick(pacing)
        self._obey(self._keyboard.pressed(), pacing)

    def _obey(self, keys: str, pacing: Pacing) -> None:
        if SPACE in keys:
            self._switch.toggle()
        if RIGHT in keys:
            self._next_is_wanted = True
        steps = keys.count(UP) - keys.count(DOWN)
        if steps:
            pacing.set_rate(pacing.rate * FASTER**steps)
            self._node.get_logger().info(f'Rate: {pacing.rate:.3g}')

    def _take_next_wish(self) -> bool:
        wish, self._next_is_wanted = self._next_is_wanted, False
        return wish
