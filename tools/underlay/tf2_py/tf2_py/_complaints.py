# SPDX-License-Identifier: Apache-2.0
"""Throttling of recurring warnings."""

from __future__ import annotations

from collections.abc import Callable
import time

_SILENCE_S = 10.0


class Complaints:
    """
    Throttled logger: logs each kind of warning at most once per period, 10 s by default.

    Parameters
    ----------
    say
        The function that logs a text.
    now_s
        The clock, in s, with an arbitrary epoch.
    silence_s
        The time for which a kind of warning is suppressed after it was logged, in s.

    """

    def __init__(
        self,
        say: Callable[[str], object],
        now_s: Callable[[], float] = time.monotonic,
        silence_s: float = _SILENCE_S,
    ) -> None:
        self._silence_s = silence_s
        self._say = say
        self._now_s = now_s
        self._said_s: dict[tuple[str, ...], float] = {}

    def add(self, text: str, *kind: str) -> None:
        """
        Log a warning unless one of the same kind was logged recently.

        Parameters
        ----------
        text
            The warning.
        *kind
            The key of its kind, such as the frame and the broadcaster.

        """
        now_s = self._now_s()
        if now_s - self._said_s.get(kind, -self._silence_s) >= self._silence_s:
            self._said_s[kind] = now_s
            self._say(text)
