# SPDX-License-Identifier: Apache-2.0
"""Warnings that come again and again."""

from __future__ import annotations

from collections.abc import Callable
import time

_SILENCE_S = 10.0


class Complaints:
    """Says each kind of complaint at most every ten seconds, or how often it is told to."""

    def __init__(
        self,
        say: Callable[[str], object],
        now_s: Callable[[], float] = time.monotonic,
        silence_s: float = _SILENCE_S,
    ) -> None:
        """Create the object; it has said nothing yet."""
        self._silence_s = silence_s
        self._say = say
        self._now_s = now_s
        self._said_s: dict[tuple[str, ...], float] = {}

    def add(self, text: str, *kind: str) -> None:
        """Say a text unless one of this kind was said just now."""
        now_s = self._now_s()
        if now_s - self._said_s.get(kind, -self._silence_s) >= self._silence_s:
            self._said_s[kind] = now_s
            self._say(text)
