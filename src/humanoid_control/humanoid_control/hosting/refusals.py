# SPDX-License-Identifier: Apache-2.0
"""Log of rejected commands, without repetition."""

from __future__ import annotations

from collections.abc import Callable
import math
import time

QUIET_S = 5.0
"""A message that has not come for this time is logged again."""
MOST = 10
"""Maximum number of different messages that are logged in that time; more are a flood."""


class Refusals:
    """
    Rate-limited log of rejected commands, which repeats no message at short intervals.

    Parameters
    ----------
    say
        Logs a message.
    clock
        Returns the time of a steady clock in s.

    """

    def __init__(
        self, say: Callable[[str], None], clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._say, self._clock = say, clock
        self._heard_s: dict[str, float] = {}
        self._since_s, self._count = clock(), 0

    def add(self, sentence: str) -> None:
        """
        Log the rejection of a command, unless the same message came a short while ago.

        A message that comes again within `QUIET_S` is dropped, and of different ones no more than
        `MOST` are logged in that time.

        Parameters
        ----------
        sentence
            The message: why the command is rejected, and what to do.

        """
        now_s = self._clock()
        is_new = now_s - self._heard_s.get(sentence, -math.inf) >= QUIET_S
        if len(self._heard_s) > MOST:
            self._heard_s.clear()
        self._heard_s[sentence] = now_s
        if is_new:
            self._say_some(sentence, now_s)

    def _say_some(self, sentence: str, now_s: float) -> None:
        """Log a new message, unless many have been logged in a short time."""
        if now_s - self._since_s >= QUIET_S:
            self._since_s, self._count = now_s, 0
        self._count += 1
        if self._count <= MOST:
            self._say(sentence)
        if self._count == MOST:
            self._say(f'That is much to refuse: for {QUIET_S:g} s, no more of it is said.')
