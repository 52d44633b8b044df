# SPDX-License-Identifier: Apache-2.0
"""Say why commands are refused: once, not as often as they come."""

from __future__ import annotations

from collections.abc import Callable
import time

QUIET_S = 5.0
"""A reason that was not heard for so long is said anew."""
_MOST = 100


class Refusals:
    """Says a sentence when it is new."""

    def __init__(
        self, say: Callable[[str], None], clock: Callable[[], float] = time.monotonic
    ) -> None:
        """Set to whom it is said."""
        self._say, self._clock = say, clock
        self._heard_s: dict[str, float] = {}

    def add(self, sentence: str) -> None:
        """Say the sentence, unless it was heard a short while ago."""
        now_s = self._clock()
        is_new = now_s - self._heard_s.get(sentence, -QUIET_S) >= QUIET_S
        if len(self._heard_s) >= _MOST:
            self._heard_s.clear()
        self._heard_s[sentence] = now_s
        if is_new:
            self._say(sentence)
